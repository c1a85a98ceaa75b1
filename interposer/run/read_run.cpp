// Read run: the rows of a run as statistics, and the repair of a run whose program has ended.
#include "tilepress/run_reader.h"

#include <unistd.h>

#include <filesystem>
#include <map>

#include "run/run_json.h"
#include "tilepress/csv_rows.h"
#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"
#include "tilepress/run_folder.h"
#include "tilepress/scheme.h"
#include "tilepress/statistics_rows.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

using FrameKey = std::pair<uint64_t, uint64_t>;  // surface, frame

Result<void> read_frames(std::string_view text, RunRecord& out) {
  CsvRecords records(text);
  const CsvRowReader<FrameStatistics> reader(records, frame_columns());
  out.frames_bytes = records.offset();
  while (records.next()) {
    FrameStatistics frame;
    if (auto read = reader.read(frame); !read) return read;
    out.frames.push_back(std::move(frame));
    out.frames_bytes = records.offset();
  }
  return {};
}

/// The columns that single schemes add to schemes.csv.
class OwnColumns {
 public:
  explicit OwnColumns(const CsvRecords& records) : records_(records) {
    for (const SchemeInfo& info : scheme_registry())
      for (const char* name : info.own_columns()) places_[info.name].emplace_back(name, records.find(name));
  }
  Result<void> read(SchemeRow& row) const {
    const auto scheme = places_.find(row.scheme.substr(0, row.scheme.find(':')));
    if (scheme == places_.end()) return {};
    for (size_t i = 0; const auto& [name, place] : scheme->second) {
      uint64_t& count = row.figures.own[i++];
      if (!place) continue;
      const std::string* field = records_.field(*place);
      if (field == nullptr) return records_.fault(name, "the field is missing");
      if (!field->empty() && !read_csv(*field, count))
        return records_.fault(name, "cannot read '" + *field + "'");
    }
    return {};
  }

 private:
  const CsvRecords& records_;
  using Place = std::pair<const char*, std::optional<size_t>>;  ///< column, place in a record
  std::map<std::string_view, std::vector<Place>> places_;       ///< by scheme name
};

Result<void> read_schemes(std::string_view text, RunRecord& out) {
  std::map<FrameKey, size_t> frame_index;
  for (size_t i = 0; i < out.frames.size(); ++i)
    frame_index[{out.frames[i].surface, out.frames[i].frame}] = i;
  std::map<std::string, size_t, std::less<>> scheme_index;
  for (size_t i = 0; i < out.scheme_names.size(); ++i) scheme_index[out.scheme_names[i]] = i;

  CsvRecords records(text);
  const CsvRowReader<SchemeRow> reader(records, scheme_columns()), checks(records, scheme_check_columns()),
      toggles(records, scheme_toggle_columns());
  const OwnColumns own(records);
  out.schemes_bytes = records.offset();
  auto frame = frame_index.end();
  while (records.next()) {
    SchemeRow row;
    row.figures.burst_bits = out.burst_bits;
    if (auto read = reader.read(row); !read) return read;
    if (auto read = own.read(row); !read) return read;
    if (auto read = checks.read(row); !read) return read;
    if (auto read = toggles.read(row); !read) return read;
    const FrameKey key{row.surface, row.frame};
    if (frame == frame_index.end() || frame->first != key) frame = frame_index.find(key);
    if (frame == frame_index.end()) continue;
    out.schemes_bytes = records.offset();
    auto scheme = scheme_index.find(row.scheme);
    if (scheme == scheme_index.end()) {
      scheme = scheme_index.emplace(row.scheme, out.scheme_names.size()).first;
      out.scheme_names.emplace_back(row.scheme);
    }
    FrameStatistics& owner = out.frames[frame->second];
    if (owner.schemes.size() <= scheme->second) owner.schemes.resize(scheme->second + 1);
    owner.schemes[scheme->second] = row.figures;
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

void RunRecord::begin_sums() {
  SchemeStatistics zero;
  zero.burst_bits = burst_bits;
  totals.assign(scheme_names.size(), zero);
  target_totals = totals;
}

void RunRecord::begin_sums(const RunOptions& options) {
  for (const SchemeSpec& spec : options.schemes) scheme_names.push_back(spec.text);
  burst_bits = options.model.burst_bits;
  begin_sums();
}

void RunRecord::add_to_sums(const FrameStatistics& frame) {
  if (frame.warmup) return;
  const bool target = is_target(frame.surface);
  ++(target ? measured_targets : measured_frames);
  std::vector<SchemeStatistics>& sums = target ? target_totals : totals;
  for (size_t i = 0; i < sums.size(); ++i) sums[i] += frame.schemes[i];
}

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

  out.begin_sums();
  for (FrameStatistics& frame : out.frames) {
    frame.schemes.resize(out.scheme_names.size());
    out.add_to_sums(frame);
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
  const std::string picture = kLivePictureFile;
  for (const std::string& file :
       {std::string(kLiveFile), picture, picture + ".tmp", std::string(kSessionMarkFile)})
    unlink((path + "/" + file).c_str());  // all but the last are of a program that was killed
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
