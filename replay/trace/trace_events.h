// Trace events: the event stream of an apitrace trace, versions 0 to 6, as a sequence of calls.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "trace_stream.h"
#include "trace_value.h"

namespace tilepress {

struct TraceFunction {
  bool known = false;
  bool watched = false;  ///< its arguments and result are kept
  std::string name;
};

struct TraceCall {
  uint64_t number = 0;
  uint64_t thread = 0;
  uint32_t function = 0;              ///< index, the same for every call of a function
  std::vector<TraceValue> arguments;  ///< by position; only of watched functions
  TraceValue result;
};

/// Calls come in the order in which they returned. Every function that reads throws TraceFault at damage.
class TraceEvents {
 public:
  static constexpr uint64_t kNewestVersion = 6;
  static constexpr uint64_t kMaxFunctions = 1 << 16;
  static constexpr uint64_t kMaxArguments = 256;
  static constexpr uint64_t kMaxNameBytes = 1024;
  static constexpr size_t kMaxOpenCalls = 4096;
  static constexpr size_t kMaxStackFrames = 1 << 22;
  static constexpr size_t kMaxProperties = 1024;
  static constexpr uint64_t kMaxPropertyBytes = 64 << 10;

  using Watch = std::function<bool(std::string_view name)>;
  TraceEvents(TraceStream& stream, Watch watch) : stream_(stream), watch_(std::move(watch)) {}

  /// Reads version, semantic version and properties. Returns false if the version is newer than
  /// kNewestVersion.
  bool read_header();
  /// Reads up to the next call that returned. Returns false at the end of the stream.
  bool next(TraceCall& call);

  uint64_t version() const { return version_; }
  uint64_t semantic_version() const { return semantic_version_; }
  const std::vector<std::pair<std::string, std::string>>& properties() const { return properties_; }
  const TraceFunction& function(uint32_t index) const { return functions_[index]; }
  uint64_t calls_entered() const { return calls_entered_; }
  /// Calls that have not returned, in the order in which they were entered. A retracer repeats them too, at
  /// the end of the trace.
  std::vector<TraceCall> open_calls() const;

 private:
  void read_enter();
  bool read_leave(TraceCall& call);
  void read_details(TraceCall& call, bool keep);
  void skip_backtrace();
  uint32_t read_function();

  TraceStream& stream_;
  Watch watch_;
  uint64_t version_ = 0, semantic_version_ = 0, calls_entered_ = 0;
  std::vector<std::pair<std::string, std::string>> properties_;
  std::vector<TraceFunction> functions_;
  std::unordered_map<uint64_t, TraceCall> open_;
  std::unordered_set<uint64_t> stack_frames_;
  TraceValueReader values_{stream_};
};

}  // namespace tilepress
