// Cache format: what the writer and the reader of frame caches share. FORMAT.md draws the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "study/cache/frame_cache.h"

namespace tilepress {

constexpr uint32_t kFrameCacheVersion = 1;
constexpr uint8_t kFrameCacheMagic[kFrameCacheMagicBytes] = {0x89, 'T', 'P', 'F', '\r', '\n', 0x1A, '\n'};
constexpr uint8_t kFrameCacheEnd[kFrameCacheMagicBytes] = {'T', 'P', 'F', 'W', 'H', 'O', 'L', 'E'};
constexpr uint32_t kCacheHeaderBytes = 16;  ///< magic, version, zeros
constexpr uint32_t kCacheEntryBytes = 80;
constexpr uint32_t kCacheFooterBytes = 48;
/// A surface's frames 0, 32, 64, ... of the file need no frame before them.
constexpr uint64_t kKeyFramePeriod = 32;

/// How the changed bytes of a frame are stored.
enum class FrameCoding : uint8_t {
  kZstd,   ///< one zstd frame; the pixels of the frame before are its prefix, except in a key frame
  kLz4Up,  ///< LZ4 blocks of differences to the byte one row above
};

/// A frame in the index.
struct CacheEntry {
  CachedFrame frame;
  bool key = false;  ///< depends on no frame before
  FrameCoding coding = FrameCoding::kZstd;
  uint64_t offset = 0, stored_bytes = 0;    ///< where the frame lies in the file
  uint64_t stored_hash = 0;                 ///< XXH3-64 of the stored bytes
  std::array<uint64_t, 2> pixel_hash = {};  ///< XXH3-128 of the pixels, low word first
};

/// All of a file but the frames.
struct CacheIndex {
  CacheOrigin origin;
  std::vector<CacheEntry> entries;
  std::string frames_digest;
};

std::string cache_header();
/// Returns index, origin and footer as they follow the last frame, which ends at `offset`.
std::string cache_tail(const CacheOrigin& origin, const std::vector<CacheEntry>& entries, uint64_t offset);
/// Reads and checks the header, the footer, the index and the origin of an open file. Error texts do not name
/// the file; the kinds are those of FrameCacheReader::open().
Result<CacheIndex> read_cache_index(int fd);

uint64_t hash_of(std::span<const std::byte> bytes);
std::array<uint64_t, 2> wide_hash_of(std::span<const std::byte> bytes);

}  // namespace tilepress
