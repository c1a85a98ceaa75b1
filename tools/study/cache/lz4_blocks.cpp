// LZ4 blocks: liblz4's block functions.
#include "study/cache/lz4_blocks.h"

#include <lz4.h>

#include <algorithm>

#include "frames/little_endian.h"

namespace tilepress {
namespace {

constexpr size_t kSizeBytes = 4;

}  // namespace

void pack_lz4_blocks(std::span<const std::byte> bytes, std::string& out) {
  out.clear();
  std::string block(static_cast<size_t>(LZ4_compressBound(static_cast<int>(kLz4BlockBytes))), '\0');
  for (size_t at = 0; at < bytes.size(); at += kLz4BlockBytes) {
    const auto part = bytes.subspan(at, std::min(kLz4BlockBytes, bytes.size() - at));
    const int size = LZ4_compress_default(reinterpret_cast<const char*>(part.data()), block.data(),
                                          static_cast<int>(part.size()), static_cast<int>(block.size()));
    put_field(out, static_cast<uint64_t>(size), kSizeBytes);
    out.append(block, 0, static_cast<size_t>(size));
  }
}

bool Lz4Blocks::next(std::span<std::byte> out) {
  if (left_.size() < kSizeBytes) return false;
  const uint32_t size = Fields({reinterpret_cast<const char*>(left_.data()), kSizeBytes}).take4();
  left_ = left_.subspan(kSizeBytes);
  if (size > left_.size() || size > static_cast<uint32_t>(LZ4_compressBound(kLz4BlockBytes))) return false;
  const int got =
      LZ4_decompress_safe(reinterpret_cast<const char*>(left_.data()), reinterpret_cast<char*>(out.data()),
                          static_cast<int>(size), static_cast<int>(out.size()));
  left_ = left_.subspan(size);
  return got >= 0 && static_cast<size_t>(got) == out.size();
}

}  // namespace tilepress
