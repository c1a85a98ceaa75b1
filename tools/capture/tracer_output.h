// Tracer output: keeps what apitrace writes on the standard error of the program that it records.
#pragma once

#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace tilepress {

/// From begin() to end(), the standard error of this process and of those that it starts leads to a thread.
/// The thread keeps the lines of apitrace and passes everything else on at once.
class TracerOutput {
 public:
  TracerOutput() = default;
  TracerOutput(const TracerOutput&) = delete;
  TracerOutput& operator=(const TracerOutput&) = delete;
  ~TracerOutput() { end(); }

  /// Without a free descriptor, nothing is kept.
  void begin();
  void end();
  /// The lines kept so far. Call after end().
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  void run(const std::stop_token& stop);
  void take(std::string_view bytes);
  void pass(std::string_view text) const;

  int given_ = -1;  ///< the standard error of the caller
  int pipe_ = -1;   ///< the end to read
  bool passes_line_ = false;
  std::string line_;  ///< the begin of a line that may be apitrace's
  std::vector<std::string> lines_;
  std::jthread thread_;
};

}  // namespace tilepress
