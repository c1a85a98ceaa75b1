// Compressed surface: checks that its parts fit each other.
#include "tilepress/compressed_surface.h"

#include <bit>

#include "tilepress/surface.h"

namespace tilepress {

Result<void> CompressedSurface::possible() const {
  const auto fail = [](std::string text) { return Error{ErrorKind::kBadBits, std::move(text)}; };
  if (width < 1 || width > kMaxSurfaceSide || height < 1 || height > kMaxSurfaceSide)
    return fail("a surface of " + std::to_string(width) + "x" + std::to_string(height) + " cannot be");
  if (static_cast<size_t>(format) >= std::size(kFormatTraits) || !traits(format).modelled)
    return fail("unknown pixel format " + std::to_string(static_cast<uint32_t>(format)));
  if (burst_bits < 16 || burst_bits > kMaxRawBlockBits || !std::has_single_bit(burst_bits))
    return fail("bursts of " + std::to_string(burst_bits) + " bits cannot be");
  if (tile_side < kBlockSide || tile_side > 4096 || tile_side % kBlockSide != 0)
    return fail("render tiles of " + std::to_string(tile_side) + " pixels cannot be");
  if (csb_bits > 256) return fail("CSB entries of " + std::to_string(csb_bits) + " bits cannot be");
  return {};
}

Result<void> CompressedSurface::consistent() const {
  if (const auto checked = possible(); !checked) return checked;
  if (payload.size() != blocks() * slot_bytes() || csb.size() != (csb_plane_bits() + 7) / 8 ||
      tables.size() != table_bits / 8 + (table_bits % 8 != 0))
    return Error{ErrorKind::kBadBits, "payload, CSB or tables are not of the surface's size"};
  return {};
}

}  // namespace tilepress
