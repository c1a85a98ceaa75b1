// Run closing: the repair of a run whose program has ended or was killed.
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "run/run_json.h"
#include "run/whole_file.h"
#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"
#include "tilepress/run_reader.h"
#include "tilepress/session_mark.h"

namespace tilepress {
namespace {

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
