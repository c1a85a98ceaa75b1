// Progress line: how far a verb is, on standard error.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace tilepress {

enum class ProgressMode : uint8_t { kAuto, kNever, kJson };

/// Adds --progress, whose word sets `mode`.
void add_progress_option(CLI::App& app, ProgressMode& mode);

/// kAuto shows one line with an estimate of the time left, rewritten in place, if standard error is a
/// terminal; kJson prints an object per line whatever standard error is. At most ten times a second.
class ProgressLine {
 public:
  /// `unit`: what is counted, in the plural.
  ProgressLine(ProgressMode mode, std::string what, std::string unit = "frames");
  ~ProgressLine();  ///< takes the line away
  /// False if show() would print nothing.
  bool is_shown() const { return mode_ != ProgressMode::kNever; }
  /// `total`: nothing when it is not known.
  void show(uint64_t done, std::optional<uint64_t> total);

 private:
  ProgressMode mode_;
  std::string what_, unit_;
  std::chrono::steady_clock::time_point begin_, shown_;
};

}  // namespace tilepress
