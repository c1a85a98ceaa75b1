// Progress line: carriage returns for people, JSON lines for programs.
#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "command_line.h"
#include "streams/messages.h"

namespace tilepress {

constexpr std::chrono::milliseconds kPeriod{100};

static std::string duration_text(double seconds) {
  const auto whole = static_cast<uint64_t>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

void add_progress_option(CLI::App& app, ProgressMode& mode) {
  add_choice_option<ProgressMode>(
      app, "--progress", mode,
      {{"auto", ProgressMode::kAuto}, {"never", ProgressMode::kNever}, {"json", ProgressMode::kJson}},
      "Progress on standard error (default: auto, one line on a terminal)");
}

ProgressLine::ProgressLine(ProgressMode mode, std::string what, std::string unit)
    : mode_(mode),
      what_(std::move(what)),
      unit_(std::move(unit)),
      begin_(std::chrono::steady_clock::now()),
      shown_(begin_) {
  if (mode_ == ProgressMode::kAuto && isatty(STDERR_FILENO) == 0) mode_ = ProgressMode::kNever;
}

ProgressLine::~ProgressLine() {
  clear_progress();
}

void ProgressLine::show(uint64_t done, std::optional<uint64_t> total) {
  const auto now = std::chrono::steady_clock::now();
  const bool last = total && done >= *total;
  if (mode_ == ProgressMode::kNever || (now - shown_ < kPeriod && !(last && mode_ == ProgressMode::kJson)))
    return;
  shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const double per_second = elapsed > 0 ? static_cast<double>(done) / elapsed : 0;
  std::optional<double> left;
  if (total && per_second > 0) left = static_cast<double>(*total - done) / per_second;
  if (mode_ == ProgressMode::kJson) {
    nlohmann::ordered_json json = {{"progress", what_}, {unit_ + "_done", done}, {"elapsed_s", elapsed}};
    if (total) json[unit_ + "_total"] = *total;
    if (left) json["eta_s"] = *left;
    tilepress::show(json.dump() + "\n");
    return;
  }
  std::string line = fmt::format("{}: {}", what_, done);
  if (total) line += fmt::format("/{} {}, {} %", *total, unit_, *total > 0 ? done * 100 / *total : 100);
  line += fmt::format(", {:.1f} {}/s", per_second, unit_);
  if (left) line += ", " + duration_text(*left) + " left";
  show_progress(line);
}

}  // namespace tilepress
