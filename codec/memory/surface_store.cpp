// Surface store: writes slots in place, and merges CSB bits, since blocks share bytes.
#include "memory/surface_store.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>

namespace tilepress {
namespace {

/// ORs `bits` bits of `from` into `plane` at bit `position`.
void merge_bits(std::span<const uint8_t> from, uint32_t bits, std::span<uint8_t> plane, uint64_t position) {
  if (bits <= kMaxBitsPerCall && position / 8 + 8 <= plane.size()) {  // one word holds all bits
    uint64_t value, word;
    std::memcpy(&value, from.data(), 8);
    value = bit_io::big_endian(value) >> position % 8;  // zeros follow the bits
    std::memcpy(&word, &plane[position / 8], 8);
    word |= bit_io::big_endian(value);
    std::memcpy(&plane[position / 8], &word, 8);
    return;
  }
  BitReader reader(from, bits);
  while (bits > 0) {
    const uint64_t byte = position / 8;
    const auto in_byte = static_cast<uint32_t>(position % 8);
    const bool word_fits = byte + 8 <= plane.size();
    const uint32_t room = word_fits ? kMaxBitsPerCall : 8 - in_byte;
    const uint32_t take = bits < room ? bits : room;
    const uint64_t value = reader.get(take);
    if (word_fits) {
      uint64_t word;
      std::memcpy(&word, &plane[byte], 8);
      word |= bit_io::big_endian(value << (64 - in_byte - take));
      std::memcpy(&plane[byte], &word, 8);
    } else {
      plane[byte] |= static_cast<uint8_t>(value << (8 - in_byte - take));
    }
    position += take;
    bits -= take;
  }
}

template <typename Word>
void repeat_ends(const uint8_t* from, size_t bytes, uint8_t* to, size_t times) {
  Word first, last;
  std::memcpy(&first, from, sizeof first);
  std::memcpy(&last, from + bytes - sizeof last, sizeof last);
  for (; times > 0; --times, to += bytes) {
    std::memcpy(to, &first, sizeof first);
    std::memcpy(to + bytes - sizeof last, &last, sizeof last);
  }
}

/// Copies a few bytes `times` times, without a call per copy.
void repeat_bytes(const uint8_t* from, size_t bytes, uint8_t* to, size_t times) {
  if (bytes >= 8 && bytes <= 16) return repeat_ends<uint64_t>(from, bytes, to, times);
  if (bytes >= 4 && bytes < 8) return repeat_ends<uint32_t>(from, bytes, to, times);
  for (; times > 0; --times, to += bytes) std::memcpy(to, from, bytes);
}

}  // namespace

void SurfaceStore::begin_frame(const SchemeSpec& spec, const ModelOptions& options, const FrameContext& frame,
                               const BlockEncoder& encoder, CompressedSurface& out) {
  out.scheme = spec;
  out.format = frame.plane.format();
  out.width = frame.plane.width();
  out.height = frame.plane.height();
  out.ordinal = frame.ordinal;
  out.tile_side = options.tile_side;
  out.burst_bits = options.burst_bits;
  out.csb_bits = encoder.csb_bits();
  out.table_bits = encoder.palette_bits();
  blocks_ = out.blocks();
  blocks_x_ = out.blocks_x();
  slot_bytes_ = out.slot_bytes();
  // Slots keep the frame before: put() clears the bytes that a block used then and does not use now.
  if (out.payload.size() != out.blocks() * out.slot_bytes() || out.block_bits.size() != out.blocks()) {
    out.payload.assign(out.blocks() * out.slot_bytes(), 0);
    out.block_bits.assign(out.blocks(), 0);
  }
  payload_ = out.payload.data();
  block_bits_ = out.block_bits.data();
  csb_bits_ = out.csb_bits;
  out.csb.assign((out.csb_plane_bits() + 7) / 8, 0);
  csb_ = out.csb;
  out.tables.assign((out.table_bits + 7) / 8, 0);
  BitWriter tables(out.tables);
  encoder.write_tables(tables);
  tables.flush();
  assert(tables.bit_count() == out.table_bits);
}

uint32_t SurfaceStore::put(const BlockEncoder& encoder, const BlockContext& block) {
  last_.number = uint64_t{block.by} * blocks_x_ + block.bx;
  uint8_t* slot = payload_ + last_.number * slot_bytes_;
  if (last_.number + 1 < blocks_) {
    // Prefetches the next slot, as far as the frame before wrote it.
    const uint8_t* next = slot + slot_bytes_;
    __builtin_prefetch(next, 1);
    const size_t bytes = block_bits_[last_.number + 1] / 8;
    for (size_t at = kCacheLineBytes; at < bytes; at += kCacheLineBytes) __builtin_prefetch(next + at, 1);
  }
  const StoredBlock stored = encoder.store(block, {slot, slot_bytes_}, last_.csb);
  uint16_t& bits = block_bits_[last_.number];
  const size_t used_before = (bits + 7u) / 8;
  if (stored.clean_bytes < used_before)
    std::memset(slot + stored.clean_bytes, 0, used_before - stored.clean_bytes);
  bits = static_cast<uint16_t>(stored.payload_bits);
  put_csb(last_, last_.number, 1);
  return stored.payload_bits;
}

void SurfaceStore::put_again(uint32_t place, uint32_t bx, uint32_t bx_end, uint32_t by) {
  const Put& kept = kept_[place];
  const uint16_t payload_bits = block_bits_[kept.number];
  const uint8_t* const from = payload_ + kept.number * slot_bytes_;
  const uint64_t first = uint64_t{by} * blocks_x_ + bx;
  uint16_t* bits = block_bits_ + first;
  uint8_t* slot = payload_ + first * slot_bytes_;
  const size_t slot_bytes = slot_bytes_;
  for (uint16_t* const end = bits + (bx_end - bx); bits != end; ++bits, slot += slot_bytes) {
    const size_t most_bytes = (std::max(payload_bits, *bits) + 7u) / 8;
    // Copies whole lines: zeros follow the payload in either slot.
    for (size_t at = 0; at < most_bytes; at += kCacheLineBytes)
      std::memcpy(slot + at, from + at, kCacheLineBytes);
    *bits = payload_bits;
  }
  put_csb(kept, first, bx_end - bx);
}

/// Writes the CSB bits of `count` blocks from number `first` on.
void SurfaceStore::put_csb(const Put& put, uint64_t first, uint32_t count) {
  if (csb_bits_ == 0) return;  // no plane
  if (const size_t bytes = csb_bits_ / 8; csb_bits_ % 8 == 0)
    return repeat_bytes(put.csb.data(), bytes, csb_.data() + first * bytes, count);
  for (uint64_t number = first; number < first + count; ++number)
    merge_bits(put.csb, csb_bits_, csb_, number * csb_bits_);
}

}  // namespace tilepress
