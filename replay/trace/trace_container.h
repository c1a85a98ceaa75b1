// Trace container: the compressed file around an apitrace event stream, read piece by piece.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "trace_input.h"

namespace tilepress {

/// What follows the last piece.
enum class ContainerEnd : uint8_t { kNotReached, kClean, kTruncated, kCorrupt };

/// Lengths in the file are never trusted: a piece is at most kMaxPieceBytes, whatever the file claims.
class TraceContainer {
 public:
  static constexpr uint32_t kMaxPieceBytes = 16u << 20;

  virtual ~TraceContainer() = default;
  /// The next piece of the stream, valid until the next call; empty once end() is not kNotReached.
  virtual std::span<const uint8_t> next() = 0;
  virtual const char* name() const = 0;
  /// False where the file carries no signature, so that damage and another kind of file look alike.
  virtual bool has_signature() const { return true; }

  ContainerEnd end() const { return end_; }
  /// One line, once the end is kTruncated or kCorrupt.
  const std::string& reason() const { return reason_; }

 protected:
  std::span<const uint8_t> finish(ContainerEnd end, std::string reason) {
    end_ = end;
    reason_ = std::move(reason);
    return {};
  }

 private:
  ContainerEnd end_ = ContainerEnd::kNotReached;
  std::string reason_;
};

/// Recognises the container by its first bytes; `input` must outlive it. Null and one line in `error` if the
/// file is empty or of a kind that is not read here.
std::unique_ptr<TraceContainer> open_container(TraceInput& input, std::string& error);

std::unique_ptr<TraceContainer> open_snappy_container(TraceInput& input);
std::unique_ptr<TraceContainer> open_brotli_container(TraceInput& input);
std::unique_ptr<TraceContainer> open_gzip_container(TraceInput& input);

}  // namespace tilepress
