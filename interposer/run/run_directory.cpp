// Run directory: the writer.
#include "tilepress/run_directory.h"

#include <filesystem>

#include "run/append_file.h"
#include "run/run_json.h"
#include "run/whole_file.h"
#include "system_calls.h"
#include "tilepress/run_reader.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {

constexpr uint64_t kJsonPeriodNs = 500'000'000;

RunWriter::RunWriter() : frames_(std::make_unique<AppendFile>()), schemes_(std::make_unique<AppendFile>()) {}

RunWriter::~RunWriter() = default;

bool RunWriter::is_open() const {
  return frames_->is_open();
}

Result<void> RunWriter::create(const std::string& path, const RunInfo& info, const RunOptions& options) {
  path_ = path;
  info_ = info;
  options_ = options;
  started_ = utc_now();
  scheme_names_.clear();
  for (const SchemeSpec& spec : options.schemes) scheme_names_.push_back(spec.text);
  totals_.assign(scheme_names_.size(), SchemeStatistics{});
  for (SchemeStatistics& total : totals_) total.burst_bits = options.model.burst_bits;
  target_totals_ = totals_;

  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
  if (holds_run(path)) return Error{ErrorKind::kExists, path + ": already holds a run"};
  if (auto made = schemes_->create(path + "/schemes.csv", schemes_csv_header()); !made) return made;
  if (auto made = frames_->create(path + "/frames.csv", frames_csv_header()); !made) return made;
  frames_->hold_lock();
  return write_json("running", "");
}

void RunWriter::program_has_ended() {
  frames_->release_lock_of_program();
}

Result<void> RunWriter::append(const FrameStatistics& frame) {
  row_buffer_.clear();
  append_schemes_rows(frame, scheme_names_, row_buffer_);
  if (auto appended = schemes_->append(row_buffer_); !appended) return appended;
  row_buffer_.clear();
  append_frames_row(frame, row_buffer_);
  if (auto appended = frames_->append(row_buffer_); !appended) return appended;
  if (!frame.warmup) {
    const bool target = is_target(frame.surface);
    ++(target ? measured_targets_ : measured_frames_);
    std::vector<SchemeStatistics>& totals = target ? target_totals_ : totals_;
    for (size_t i = 0; i < totals.size(); ++i) totals[i] += frame.schemes[i];
  }
  // A failure here loses nothing: run.json repeats the rows. A program that has dropped privileges can append
  // to open files and not replace one.
  if (clock_ns(CLOCK_MONOTONIC) - last_json_ns_ >= kJsonPeriodNs) (void)write_json("running", "");
  return {};
}

void RunWriter::set_counts(const RunCounts& counts, const RunCounts& targets) {
  counts_ = counts;
  target_counts_ = targets;
  if (is_open() && clock_ns(CLOCK_MONOTONIC) - last_json_ns_ >= kJsonPeriodNs)
    (void)write_json("running", "");
}

void RunWriter::set_info(const RunInfo& info) {
  info_ = info;
}

Result<void> RunWriter::finish(const std::string& state, const std::string& reason) {
  if (!is_open()) return Error{ErrorKind::kFile, path_ + ": no run is open"};
  return write_json(state, reason);
}

Result<void> RunWriter::write_json(const std::string& state, const std::string& reason) {
  last_json_ns_ = clock_ns(CLOCK_MONOTONIC);
  return replace_file(path_ + "/run.json",
                      run_json_text({state, reason, started_, info_, options_, counts_, measured_frames_,
                                     totals_, target_counts_, measured_targets_, target_totals_}));
}

}  // namespace tilepress
