// Block log reader: no size that a record claims is trusted before the file has room for it.
#include "memory_trace/block_log_reader.h"

#include <algorithm>
#include <cstring>

#include "tilepress/block_log.h"
#include "tilepress/file_error.h"

namespace tilepress {
namespace {

/// Takes the shape that a record claims.
bool take_shape(const BlockLogRecord& record, CompressedSurface& out) {
  out.width = record.width;
  out.height = record.height;
  out.csb_bits = record.csb_bits;
  out.table_bits = record.table_bits;
  if (record.format >= std::size(kFormatTraits)) return false;
  out.format = static_cast<PixelFormat>(record.format);
  constexpr uint64_t kMostTableBits = uint64_t{1} << 40;
  return out.possible() && record.table_bits < kMostTableBits;
}

}  // namespace

bool BlockLogReader::read_bytes(uint64_t offset, void* out, uint64_t size) {
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(offset));
  return static_cast<bool>(file_.read(static_cast<char*>(out), static_cast<std::streamsize>(size)));
}

Result<void> BlockLogReader::open(const std::string& path) {
  path_ = path;
  file_.open(path, std::ios::binary | std::ios::ate);
  if (!file_) return file_error(path);
  const auto file_bytes = static_cast<uint64_t>(file_.tellg());
  if (const auto read = read_start(file_bytes); !read) return read;
  return read_heads(file_bytes);
}

Result<void> BlockLogReader::read_start(uint64_t file_bytes) {
  constexpr uint32_t kMostSchemeBytes = 4096;
  BlockLogStart start;
  if (file_bytes < sizeof start || !read_bytes(0, &start, sizeof start) ||
      std::memcmp(start.magic, kBlockLogMagic, sizeof start.magic) != 0)
    return bad("not a block log");
  if (start.version != kBlockLogVersion)
    return bad("version " + std::to_string(start.version) + " of the block log is not known");
  if (start.scheme_bytes > kMostSchemeBytes || file_bytes - sizeof start < start.scheme_bytes)
    return bad("cut short in its head");
  std::string scheme(start.scheme_bytes, '\0');
  if (!read_bytes(sizeof start, scheme.data(), scheme.size())) return bad("cut short in its head");
  const auto spec = parse_scheme(scheme, SchemeFiles::kLeave);
  if (!spec) return bad(spec.error().text);
  shape_.scheme = *spec;
  shape_.tile_side = start.tile_side;
  shape_.burst_bits = start.burst_bits;
  shape_.width = shape_.height = 1;
  if (const auto possible = shape_.possible(); !possible) return bad(possible.error().text);
  has_data_ = start.has_data != 0;
  first_record_ = sizeof start + start.scheme_bytes;
  return {};
}

Result<void> BlockLogReader::read_heads(uint64_t file_bytes) {
  CompressedSurface shape = shape_;
  for (uint64_t offset = first_record_; file_bytes - offset >= sizeof(BlockLogRecord);) {
    BlockLogRecord record;
    if (!read_bytes(offset, &record, sizeof record)) return bad("cannot be read");
    const uint64_t room = file_bytes - offset - sizeof record;
    if (record.bytes > room) return {};
    if (!take_shape(record, shape) || record.bytes < 2 * shape.blocks())
      return bad("damaged record of frame " + std::to_string(record.frame));
    frames_.push_back({record.frame, record.surface, record.time_ns, record.table_bits, offset});
    offset += sizeof record + record.bytes;
  }
  return {};
}

Result<void> BlockLogReader::read(size_t index, CompressedSurface& out) {
  const LoggedFrame& frame = frames_[index];
  const Error damaged = bad("damaged record of frame " + std::to_string(frame.frame));
  BlockLogRecord record;
  out = shape_;
  if (!read_bytes(frame.offset, &record, sizeof record) || !take_shape(record, out)) return damaged;
  out.block_bits.resize(out.blocks());
  uint64_t offset = frame.offset + sizeof record;
  if (!read_bytes(offset, out.block_bits.data(), 2 * out.blocks())) return damaged;
  offset += 2 * out.blocks();
  uint64_t payload_bytes = 0;
  for (const uint16_t bits : out.block_bits) {
    if (bits > out.raw_block_bits()) return damaged;
    payload_bytes += (bits + 7u) / 8;
  }
  const uint64_t csb_bytes = (out.csb_plane_bits() + 7) / 8, table_bytes = (out.table_bits + 7) / 8;
  const uint64_t data_bytes = has_data_ ? payload_bytes + csb_bytes + table_bytes : 0;
  if (record.bytes != 2 * out.blocks() + data_bytes) return damaged;
  if (!has_data_) return {};
  std::vector<uint8_t> bytes(data_bytes);
  if (!read_bytes(offset, bytes.data(), bytes.size())) return damaged;
  out.payload.assign(out.blocks() * out.slot_bytes(), 0);
  auto from = bytes.cbegin();
  for (size_t block = 0; block < out.block_bits.size(); ++block) {
    const auto filled = static_cast<ptrdiff_t>((out.block_bits[block] + 7u) / 8);
    std::copy_n(from, filled, out.payload.begin() + static_cast<ptrdiff_t>(block * out.slot_bytes()));
    from += filled;
  }
  out.csb.assign(from, from + static_cast<ptrdiff_t>(csb_bytes));
  out.tables.assign(from + static_cast<ptrdiff_t>(csb_bytes), bytes.cend());
  return {};
}

}  // namespace tilepress
