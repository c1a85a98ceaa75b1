// Memory map: addresses rounded up to what the spec asks for.
#include "memory_trace/memory_map.h"

#include <algorithm>

namespace tilepress {

static uint64_t round_up(uint64_t address, uint64_t step) {
  return (address + step - 1) / step * step;
}

void MemoryMap::add(uint32_t surface, const CompressedSurface& shape, uint64_t most_table_bits) {
  constexpr uint64_t kPageBytes = 4096;
  const uint64_t burst = shape.burst_bits / 8;
  const uint64_t part_step = std::max<uint64_t>(kCacheLineBytes, burst);
  const auto whole_bursts = [&](uint64_t bits) { return (bits + shape.burst_bits - 1) / shape.burst_bits * burst; };
  SurfacePlace place;
  place.payload = round_up(next_, std::max(kPageBytes, burst));
  place.csb = round_up(place.payload + shape.blocks() * shape.slot_bytes(), part_step);
  place.tables = round_up(place.csb + whole_bursts(shape.csb_plane_bits()), part_step);
  place.end = place.tables + whole_bursts(most_table_bits);
  places_[surface] = place;
  next_ = place.end;
}

}  // namespace tilepress
