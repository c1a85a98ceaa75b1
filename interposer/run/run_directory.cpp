// Run directory: the writer.
#include "tilepress/run_directory.h"

#include <filesystem>

#include "run/run_json.h"
#include "system_calls.h"
#include "tilepress/statistics_rows.h"
#include "tilepress/utc_time.h"
#include "tilepress/whole_file.h"

namespace tilepress {

constexpr uint64_t kJsonPeriodNs = 500'000'000;

Result<void> RunWriter::create(const std::string& path, const RunInfo& info, const RunOptions& options) {
  options_ = options;
  record_ = {};
  record_.path = path;
  record_.started = utc_now();
  record_.info = info;
  record_.begin_sums(options);
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
  if (holds_run(path)) return Error{ErrorKind::kExists, path + ": already holds a run"};
  if (auto made = schemes_.create(path + "/schemes.csv", schemes_csv_header()); !made) return made;
  if (auto made = frames_.create(path + "/frames.csv", frames_csv_header()); !made) return made;
  frames_.hold_lock();
  return write_json("running", "");
}

Result<void> RunWriter::append(const FrameStatistics& frame) {
  row_buffer_.clear();
  append_schemes_rows(frame, record_.scheme_names, row_buffer_);
  if (auto appended = schemes_.append(row_buffer_); !appended) return appended;
  row_buffer_.clear();
  append_frames_row(frame, row_buffer_);
  if (auto appended = frames_.append(row_buffer_); !appended) return appended;
  record_.add_to_sums(frame);
  // A failure here loses nothing: run.json repeats the rows. A program that has dropped privileges can append
  // to open files and not replace one.
  if (clock_ns(CLOCK_MONOTONIC) - last_json_ns_ >= kJsonPeriodNs) (void)write_json("running", "");
  return {};
}

void RunWriter::set_counts(const RunCounts& counts, const RunCounts& targets) {
  record_.counts = counts;
  record_.target_counts = targets;
  if (is_open() && clock_ns(CLOCK_MONOTONIC) - last_json_ns_ >= kJsonPeriodNs)
    (void)write_json("running", "");
}

Result<void> RunWriter::finish(const std::string& state, const std::string& reason) {
  if (!is_open()) return Error{ErrorKind::kFile, path() + ": no run is open"};
  return write_json(state, reason);
}

Result<void> RunWriter::write_json(const std::string& state, const std::string& reason) {
  last_json_ns_ = clock_ns(CLOCK_MONOTONIC);
  record_.state = state;
  record_.reason = reason;
  return replace_file(path() + "/run.json", run_json_text(record_, options_));
}

}  // namespace tilepress
