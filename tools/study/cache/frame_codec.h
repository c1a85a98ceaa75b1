// Frame codec: the bytes of one frame in a cache file. FORMAT.md draws them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "study/cache/cache_format.h"

namespace tilepress {

/// Encodes the frames of one surface in order. Not thread-safe.
class FrameEncoder {
 public:
  FrameEncoder();
  FrameEncoder(const FrameEncoder&) = delete;
  FrameEncoder& operator=(const FrameEncoder&) = delete;
  ~FrameEncoder();

  /// Encodes `pixels`, and sets key and coding of `entry`, whose frame is set. The bytes are valid until the
  /// next call. Error: kSystem, a library failed.
  Result<std::span<const std::byte>> encode(std::span<const std::byte> pixels, CacheEntry& entry);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Decodes frames of any surface. Not thread-safe.
class FrameDecoder {
 public:
  FrameDecoder();
  FrameDecoder(FrameDecoder&&) noexcept;
  FrameDecoder& operator=(FrameDecoder&&) noexcept;
  ~FrameDecoder();

  /// Turns `pixels`, which holds the frame before unless the entry is a key frame, into the entry's frame.
  /// Its size is that of the frame. Returns kBadBits for bytes that no encoder writes; `pixels` is undefined
  /// then.
  Result<void> decode(const CacheEntry& entry, std::span<const std::byte> stored,
                      std::span<std::byte> pixels);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tilepress
