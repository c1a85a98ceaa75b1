// Block log: the writer.
#include "tilepress/block_log.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace tilepress {
namespace {

static_assert(std::endian::native == std::endian::little, "the structs are written as they are");

template <class T>
void append_bytes(std::string& out, const T* values, size_t count) {
  out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// The filled bytes of each slot, then CSB and tables.
void append_data(std::string& out, const CompressedSurface& surface) {
  const uint32_t slot = surface.slot_bytes();
  for (size_t block = 0; block < surface.block_bits.size(); ++block)
    append_bytes(out, &surface.payload[block * slot], (surface.block_bits[block] + 7u) / 8);
  append_bytes(out, surface.csb.data(), surface.csb.size());
  append_bytes(out, surface.tables.data(), surface.tables.size());
}

}  // namespace

Result<void> BlockLog::create(const std::string& run_path, const RunOptions& options) {
  if (options.block_log.empty()) return {};
  const auto wanted = std::ranges::find(options.schemes, options.block_log, &SchemeSpec::text);
  if (wanted == options.schemes.end())
    return Error{ErrorKind::kBadValue, "block log: the run has no scheme '" + options.block_log + "'"};
  scheme_ = static_cast<size_t>(wanted - options.schemes.begin());
  has_data_ = options.block_log_data;
  BlockLogStart start{};
  std::memcpy(start.magic, kBlockLogMagic, sizeof start.magic);
  start.version = kBlockLogVersion;
  start.tile_side = options.model.tile_side;
  start.burst_bits = options.model.burst_bits;
  start.has_data = has_data_;
  start.scheme_bytes = static_cast<uint32_t>(wanted->text.size());
  std::string bytes;
  append_bytes(bytes, &start, 1);
  return file_.create(run_path + "/" + std::string(kBlockLogName), bytes + wanted->text);
}

std::string BlockLog::record(const FrameStatistics& frame, const BlockBits& bits,
                             std::span<const CompressedSurface> surfaces) const {
  const SchemeStatistics& figures = frame.schemes[scheme_];
  if (figures.skipped) return {};
  const std::vector<uint16_t>& blocks = bits.schemes[scheme_];
  BlockLogRecord head{};
  head.frame = frame.frame;
  head.time_ns = frame.time_ns;
  head.table_bits = figures.palette_bits;
  head.surface = frame.surface;
  head.width = frame.width;
  head.height = frame.height;
  head.format = static_cast<uint32_t>(frame.format);
  head.csb_bits = static_cast<uint32_t>(figures.csb_bits / blocks.size());
  std::string out(sizeof head, '\0');
  append_bytes(out, blocks.data(), blocks.size());
  if (has_data_) append_data(out, surfaces[scheme_]);
  head.bytes = out.size() - sizeof head;
  std::memcpy(out.data(), &head, sizeof head);
  return out;
}

Result<void> BlockLog::append(const std::string& record) {
  return record.empty() ? Result<void>() : file_.append(record);
}

}  // namespace tilepress
