// Trace container: the compressed file around an apitrace event stream, read piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "tilepress/result.h"
#include "tilepress/trace_summary.h"

namespace tilepress {

/// Why the reader stopped before the end of a trace. Thrown by the parts of the trace reader, at any depth,
/// and caught by its public functions, which return it as the summary's state.
struct TraceFault {
  TraceState state;  ///< kTruncated or kCorrupt
  std::string reason;
};

[[noreturn]] inline void fail_corrupt(std::string reason) {
  throw TraceFault{TraceState::kCorrupt, std::move(reason)};
}
[[noreturn]] inline void fail_truncated(std::string reason) {
  throw TraceFault{TraceState::kTruncated, std::move(reason)};
}

/// The bytes of a trace file, on disk or in memory.
class TraceInput {
 public:
  explicit TraceInput(std::span<const uint8_t> memory);
  /// Opens a regular file. Error: kFile, or kUnsupported if the file is not a regular one.
  static Result<TraceInput> open(const std::string& path);

  uint64_t size() const { return size_; }
  /// Reads `to.size()` bytes, and fewer only at the end of the file. Throws TraceFault if the disk fails.
  size_t read(std::span<uint8_t> to);
  void rewind() { std::rewind(file_.get()); }

 private:
  TraceInput(FILE* file, uint64_t size) : file_(file, fclose), size_(size) {}

  std::unique_ptr<FILE, int (*)(FILE*)> file_;
  uint64_t size_;
};

/// No length in the file is trusted: a piece has at most kMaxPieceBytes, whatever the file claims.
class TraceContainer {
 public:
  static constexpr uint32_t kMaxPieceBytes = 16u << 20;

  virtual ~TraceContainer() = default;
  /// Returns the next piece of the stream, valid until the next call; empty at the end of the file. Throws
  /// TraceFault where the file is cut off or damaged, after all pieces before that place.
  virtual std::span<const uint8_t> next() = 0;
  virtual const char* name() const = 0;
  /// False if the format has no signature, so that a damaged file looks like a file of another kind.
  virtual bool has_signature() const { return true; }
};

/// Recognises the container by its first bytes. `input` must outlive the container. Error: kUnsupported if
/// the file is empty or its container cannot be read.
Result<std::unique_ptr<TraceContainer>> open_container(TraceInput& input);

std::unique_ptr<TraceContainer> open_snappy_container(TraceInput& input);
std::unique_ptr<TraceContainer> open_brotli_container(TraceInput& input);
std::unique_ptr<TraceContainer> open_gzip_container(TraceInput& input);

}  // namespace tilepress
