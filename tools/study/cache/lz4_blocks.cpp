// LZ4 blocks: liblz4's block functions.
#include "study/cache/lz4_blocks.h"

#include <lz4.h>
#include <lz4hc.h>

#include <algorithm>
#include <vector>

#include "frames/little_endian.h"

namespace tilepress {
namespace {

constexpr size_t kWordBytes = 4;
constexpr uint32_t kStoredFlag = uint32_t{1} << 31;
/// The compressor's lowest level: its blocks are smaller than those of the default, and decode faster.
constexpr int kLevel = 3;
/// A block that is smaller than this share of its bytes is never stored.
constexpr double kStoredShare = 0.5;

struct Block {
  std::span<const std::byte> plain;
  std::string packed;
  bool stored = false;

  size_t bytes() const { return kWordBytes + (stored ? plain.size() : packed.size()); }
  double share() const { return static_cast<double>(packed.size()) / static_cast<double>(plain.size()); }
};

Block pack_block(std::span<const std::byte> plain) {
  Block block{plain,
              std::string(static_cast<size_t>(LZ4_compressBound(static_cast<int>(plain.size()))), '\0')};
  const int size =
      LZ4_compress_HC(reinterpret_cast<const char*>(plain.data()), block.packed.data(),
                      static_cast<int>(plain.size()), static_cast<int>(block.packed.size()), kLevel);
  block.packed.resize(static_cast<size_t>(size));
  block.stored = block.packed.size() >= plain.size();
  return block;
}

/// Stores the blocks that gain least, within the budget.
void store_some(std::vector<Block>& blocks, size_t budget) {
  size_t sum = 0;
  std::vector<Block*> worst;
  for (Block& block : blocks) {
    sum += block.bytes();
    if (!block.stored && block.share() > kStoredShare) worst.push_back(&block);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Block* a, const Block* b) { return a->share() > b->share(); });
  for (Block* block : worst) {
    sum += block->plain.size() - block->packed.size();
    if (sum > budget) return;
    block->stored = true;
  }
}

}  // namespace

void pack_lz4_blocks(std::span<const std::byte> bytes, size_t budget, std::string& out) {
  std::vector<Block> blocks;
  for (size_t at = 0; at < bytes.size(); at += kLz4BlockBytes)
    blocks.push_back(pack_block(bytes.subspan(at, std::min(kLz4BlockBytes, bytes.size() - at))));
  store_some(blocks, budget);
  out.clear();
  for (const Block& block : blocks) {
    put_field(out, block.stored ? block.plain.size() | kStoredFlag : block.packed.size(), kWordBytes);
    if (block.stored)
      out.append(reinterpret_cast<const char*>(block.plain.data()), block.plain.size());
    else
      out += block.packed;
  }
}

std::span<const std::byte> Lz4Blocks::next(std::span<std::byte> room) {
  if (left_.size() < kWordBytes) return {};
  const uint32_t word = Fields({reinterpret_cast<const char*>(left_.data()), kWordBytes}).take4();
  const bool stored = (word & kStoredFlag) != 0;
  const uint32_t size = word & ~kStoredFlag;
  left_ = left_.subspan(kWordBytes);
  if (size > left_.size() || size > static_cast<uint32_t>(LZ4_compressBound(kLz4BlockBytes))) return {};
  const auto block = left_.first(size);
  left_ = left_.subspan(size);
  if (stored) return size == room.size() ? block : std::span<const std::byte>();
  const int got =
      LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()), reinterpret_cast<char*>(room.data()),
                          static_cast<int>(size), static_cast<int>(room.size()));
  if (got < 0 || static_cast<size_t>(got) != room.size()) return {};
  return room;
}

}  // namespace tilepress
