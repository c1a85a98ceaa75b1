// Trace container: the compressed file around an apitrace event stream, read piece by piece.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "tilepress/result.h"
#include "trace_input.h"

namespace tilepress {

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
