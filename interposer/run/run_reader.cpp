// Run reader: CSV columns by name into statistics, and the repair of a run whose program was killed.
#include "tilepress/run_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <map>

#include "run/run_json.h"
#include "tilepress/session_mark.h"
#include "tilepress/csv_reader.h"
#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

using FrameKey = std::pair<uint64_t, uint64_t>;  // surface, frame

bool read_text(const std::string& path, std::string& text, std::string& reason) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    reason = std::strerror(errno);
    return false;
  }
  text.clear();
  char buffer[1 << 16];
  ssize_t got = 0;
  while ((got = read(fd, buffer, sizeof buffer)) > 0 || (got < 0 && errno == EINTR))
    if (got > 0) text.append(buffer, static_cast<size_t>(got));
  if (got < 0) reason = std::strerror(errno);
  close(fd);
  return got == 0;
}

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

bool read_frames(std::string_view text, RunRecord& out, std::string& error) {
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
    if (!fault.empty()) {
      error = out.path + "/frames.csv: " + fault;
      return false;
    }
    frame.format = *format;
    out.frames.push_back(std::move(frame));
    out.frames_bytes = table.offset();
  }
  return true;
}

bool read_schemes(std::string_view text, RunRecord& out, std::string& error) {
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
    if (const std::string fault = table.fault(); !fault.empty()) {
      error = out.path + "/schemes.csv: " + fault;
      return false;
    }
    if (frame == frame_index.end()) continue;
    out.schemes_bytes = table.offset();
    const auto [position, added] = scheme_index.try_emplace(name, out.scheme_names.size());
    if (added) out.scheme_names.push_back(name);
    FrameStatistics& owner = out.frames[frame->second];
    if (owner.schemes.size() <= position->second) owner.schemes.resize(position->second + 1);
    owner.schemes[position->second] = row;
  }
  return true;
}

bool cut_file(const std::string& path, uint64_t end, std::string& error) {
  std::error_code code;
  const uint64_t size = std::filesystem::file_size(path, code);
  if (!code && end < size) std::filesystem::resize_file(path, end, code);
  if (code) error = path + ": " + code.message();
  return !code;
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

bool read_run(const std::string& path, RunRecord& out, std::string& error) {
  out = RunRecord{};
  out.path = path;
  if (!holds_run(path)) {
    error = path + ": holds no run";
    return false;
  }
  std::string json, reason;
  if (read_text(path + "/run.json", json, reason) && !read_run_json(json, out, reason)) {
    error = path + "/run.json: " + reason;
    return false;
  }
  const auto read_rows = [&](const char* name, bool (*read)(std::string_view, RunRecord&, std::string&)) {
    std::string text;
    if (read_text(path + "/" + name, text, reason)) return read(text, out, error);
    error = path + "/" + name + ": " + reason;
    return false;
  };
  if (!read_rows("frames.csv", read_frames) || !read_rows("schemes.csv", read_schemes)) return false;

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
  return true;
}

bool close_run(const RunEnd& end, RunRecord& record, std::string& error) {
  const std::string& path = record.path;
  if (!cut_file(path + "/frames.csv", record.frames_bytes, error)) return false;
  if (!cut_file(path + "/schemes.csv", record.schemes_bytes, error)) return false;
  RunCounts presented, targets;
  {
    LiveReader page;
    std::string no_page;
    if (page.open(path, no_page)) {
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
  std::string json, reason;
  read_text(path + "/run.json", json, reason);
  if (replace_file(path + "/run.json", finished_run_json(json, record, end), reason)) return true;
  error = path + "/run.json: " + reason;
  return false;
}

}  // namespace tilepress
