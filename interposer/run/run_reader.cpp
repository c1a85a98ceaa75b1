// Run reader: CSV columns by name into statistics, and the repair of a run whose program was killed.
#include "tilepress/run_reader.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>

#include "run/run_json.h"
#include "run/whole_file.h"
#include "tilepress/csv_reader.h"
#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"
#include "tilepress/scheme.h"
#include "tilepress/session_mark.h"

namespace tilepress {
namespace {

using FrameKey = std::pair<uint64_t, uint64_t>;  // surface, frame

/// The records of one file, their fields found by column name.
class Table {
 public:
  explicit Table(std::string_view text) : reader_(text) {
    if (!reader_.next(header_)) return;
    for (size_t i = 0; i < header_.size(); ++i) {
      const auto [column, added] = columns_.try_emplace(header_[i], i);
      if (added) continue;
      header_[column->second].clear();  // of two of a name the last counts
      column->second = i;
    }
  }
  bool next() {
    likely_ = 0;
    return reader_.next(fields_);
  }
  size_t offset() const { return reader_.offset(); }
  /// What is wrong with the record, empty if nothing.
  std::string fault() const {
    return fault_.empty() ? "" : "record " + std::to_string(reader_.record()) + ": " + fault_;
  }
  bool has(const char* name) { return column_of(name) < header_.size(); }
  const std::string& text(const char* name) {
    static const std::string kNothing;
    const size_t column = column_of(name);
    if (column >= std::min(header_.size(), fields_.size())) {
      fault_ = std::string("no field ") + name;
      return kNothing;
    }
    return fields_[column];
  }
  template <typename T>
  T number(const char* name) {
    T value{};
    const std::string& field = text(name);
    const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (code != std::errc() || end != field.data() + field.size())
      fault_ = std::string(name) + " is no number";
    return value;
  }
  template <typename T>
  T number_or_zero(const char* name) {
    return has(name) && !text(name).empty() ? number<T>(name) : T{};
  }

 private:
  /// As many as there are if none has the name. Columns are asked for in order, most often.
  size_t column_of(const char* name) {
    for (const size_t guess : {likely_, likely_ - 1})
      if (guess < header_.size() && header_[guess] == name) return likely_ = guess + 1, guess;
    const auto found = columns_.find(name);
    if (found == columns_.end()) return header_.size();
    likely_ = found->second + 1;
    return found->second;
  }
  CsvReader reader_;
  std::vector<std::string> header_, fields_;
  std::map<std::string, size_t, std::less<>> columns_;
  size_t likely_ = 0;  ///< column after the one asked for last
  std::string fault_;
};

bool is_true(const std::string& field) {
  return field == "1" || field == "true";
}

std::optional<PixelFormat> format_of(const std::string& name) {
  for (size_t i = 0; i < std::size(kFormatTraits); ++i)
    if (kFormatTraits[i].name == name) return static_cast<PixelFormat>(i);
  return std::nullopt;
}

Result<void> read_frames(std::string_view text, RunRecord& out) {
  Table table(text);
  out.frames_bytes = table.offset();
  while (table.next()) {
    FrameStatistics frame;
    frame.frame = table.number<uint64_t>("frame");
    frame.surface = table.number<uint32_t>("surface");
    frame.width = table.number<uint32_t>("width");
    frame.height = table.number<uint32_t>("height");
    const auto format = format_of(table.text("format"));
    frame.warmup = is_true(table.text("warmup"));
    frame.time_ns = table.number<uint64_t>("time_ns");
    frame.metrics.unique_colors = table.number<uint64_t>("unique_colors");
    frame.metrics.entropy = table.number<double>("entropy");
    frame.metrics.pixel_change = table.number<double>("pixel_change");
    frame.metrics.color_change = table.number<double>("color_change");
    frame.metrics.fvc_coverage = table.number<double>("fvc_coverage");
    frame.metrics.fvc_relative_coverage = table.number<double>("fvc_relative_coverage");
    frame.metrics.top100_coverage = table.number<double>("top100_coverage");
    frame.readback_ns = table.number<uint64_t>("readback_ns");
    frame.encode_ns = table.number<uint64_t>("encode_ns");
    std::string fault = table.fault();
    if (fault.empty() && !format) fault = "unknown format " + table.text("format");
    if (!fault.empty()) return Error{ErrorKind::kFile, std::move(fault)};
    frame.format = *format;
    out.frames.push_back(std::move(frame));
    out.frames_bytes = table.offset();
  }
  return {};
}

Result<void> read_schemes(std::string_view text, RunRecord& out) {
  std::map<FrameKey, size_t> frame_index;
  for (size_t i = 0; i < out.frames.size(); ++i)
    frame_index[{out.frames[i].surface, out.frames[i].frame}] = i;
  std::map<std::string, size_t> scheme_index;
  for (size_t i = 0; i < out.scheme_names.size(); ++i) scheme_index[out.scheme_names[i]] = i;

  Table table(text);
  out.schemes_bytes = table.offset();
  auto frame = frame_index.end();
  while (table.next()) {
    SchemeStatistics row;
    const auto number = table.number<uint64_t>("frame");
    const FrameKey key{table.number<uint64_t>("surface"), number};
    if (frame == frame_index.end() || frame->first != key) frame = frame_index.find(key);
    const std::string name = table.text("scheme");
    row.blocks = table.number<uint64_t>("blocks");
    row.raw_bits = table.number<uint64_t>("raw_bits");
    row.payload_bits = table.number<uint64_t>("payload_bits");
    row.bursts = table.number<uint64_t>("bursts");
    row.burst_bits = out.burst_bits;
    row.csb_bits = table.number<uint64_t>("csb_bits");
    row.palette_bits = table.number<uint64_t>("palette_bits");
    row.extra_bits = table.number_or_zero<uint64_t>("extra_bits");
    if (const SchemeInfo* info = find_scheme(name.substr(0, name.find(':'))))
      for (size_t i = 0; i < info->columns.size(); ++i)
        row.own[i] = table.number_or_zero<uint64_t>(info->columns[i]);
    row.checked_blocks = table.number_or_zero<uint64_t>("checked_blocks");
    row.mismatched_blocks = table.number_or_zero<uint64_t>("mismatched_blocks");
    if (std::string fault = table.fault(); !fault.empty()) return Error{ErrorKind::kFile, std::move(fault)};
    if (frame == frame_index.end()) continue;
    out.schemes_bytes = table.offset();
    const auto [position, added] = scheme_index.try_emplace(name, out.scheme_names.size());
    if (added) out.scheme_names.push_back(name);
    FrameStatistics& owner = out.frames[frame->second];
    if (owner.schemes.size() <= position->second) owner.schemes.resize(position->second + 1);
    owner.schemes[position->second] = row;
  }
  return {};
}

Result<void> cut_file(const std::string& path, uint64_t end) {
  std::error_code code;
  const uint64_t size = std::filesystem::file_size(path, code);
  if (!code && end < size) std::filesystem::resize_file(path, end, code);
  if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
  return {};
}

/// The rows count as captured, whatever the run last said of itself. `page`: what the program's own threads
/// have counted. Frames that were presented and left nothing are lost.
void settle(RunCounts& counts, const RunCounts& page, uint64_t captured) {
  counts.captured = captured;
  for (const auto member : {&RunCounts::seen, &RunCounts::dropped, &RunCounts::skipped,
                            &RunCounts::unsupported, &RunCounts::not_captured})
    counts.*member = std::max(counts.*member, page.*member);
  const uint64_t known =
      captured + counts.dropped + counts.skipped + counts.unsupported + counts.not_captured;
  if (counts.seen > known) counts.not_captured += counts.seen - known;
  counts.seen = std::max(counts.seen, known);
}

}  // namespace

bool holds_run(const std::string& path) {
  for (const char* name : {"frames.csv", "schemes.csv", "run.json"}) {
    std::error_code code;
    if (std::filesystem::exists(path + "/" + name, code)) return true;
  }
  return false;
}

Result<RunRecord> read_run(const std::string& path) {
  if (!holds_run(path)) return Error{ErrorKind::kFile, path + ": holds no run"};
  RunRecord out;
  out.path = path;
  if (const auto json = read_whole_file(path + "/run.json"))
    if (auto read = read_run_json(*json, out); !read) return about(path + "/run.json", read.error());
  using Part = std::pair<const char*, Result<void> (*)(std::string_view, RunRecord&)>;
  for (const auto& [name, read_rows] : {Part("frames.csv", read_frames), Part("schemes.csv", read_schemes)}) {
    const std::string file = path + "/" + name;
    const auto text = read_whole_file(file);
    if (!text) return text.error();
    if (auto read = read_rows(*text, out); !read) return about(file, read.error());
  }

  out.totals.assign(out.scheme_names.size(), SchemeStatistics{});
  for (SchemeStatistics& total : out.totals) total.burst_bits = out.burst_bits;
  out.target_totals = out.totals;
  for (FrameStatistics& frame : out.frames) {
    frame.schemes.resize(out.scheme_names.size());
    if (frame.warmup) continue;
    const bool target = is_target(frame.surface);
    ++(target ? out.measured_targets : out.measured_frames);
    std::vector<SchemeStatistics>& totals = target ? out.target_totals : out.totals;
    for (size_t i = 0; i < frame.schemes.size(); ++i) totals[i] += frame.schemes[i];
  }
  return out;
}

Result<void> close_run(const RunEnd& end, RunRecord& record) {
  const std::string& path = record.path;
  if (auto cut = cut_file(path + "/frames.csv", record.frames_bytes); !cut) return cut;
  if (auto cut = cut_file(path + "/schemes.csv", record.schemes_bytes); !cut) return cut;
  RunCounts presented, targets;
  {
    LiveReader page;
    if (page.open(path)) {
      presented = page.presented();
      targets = page.targets();
    }
  }
  for (const char* file : {kLiveFile, kLivePictureFile, kSessionMarkFile})
    unlink((path + "/" + file).c_str());  // the first two are of a program that was killed
  if (end.overrules || record.state == "running" || record.state == "ended" ||
      (end.signal && record.state != "failed")) {
    record.state = end.state;
    record.reason = end.reason;
  }
  if (!end.program.empty()) record.info.program = end.program;
  if (!end.via.empty()) record.info.via = end.via;
  for (const auto& member : end.further) record.info.further.push_back(member);
  settle(record.counts, presented, record.presented_frames());
  settle(record.target_counts, targets, record.frames.size() - record.presented_frames());
  const auto json = read_whole_file(path + "/run.json");
  return replace_file(path + "/run.json", finished_run_json(json ? *json : "", record, end));
}

}  // namespace tilepress
