// Memory map: where the surfaces of a memory trace lie.
#pragma once

#include <cstdint>
#include <map>

#include "tilepress/compressed_surface.h"
#include "tilepress/surface_reader.h"

namespace tilepress {

//   base                                                              4 KiB or a burst: the larger
//   │ slot 0 │ slot 1 │ … │ CSB plane, whole bursts │ tables, whole bursts │ next surface …
//   └ S0 bytes each, blocks in raster order ┘└ both at max(64 bytes, a burst) ┘

/// Addresses of the parts of one surface, in bytes.
struct SurfacePlace {
  uint64_t payload = 0, csb = 0, tables = 0;
  uint64_t end = 0;  ///< first byte after the tables
  uint64_t of(SurfacePart part) const {
    return part == SurfacePart::kPayload ? payload : part == SurfacePart::kCsb ? csb : tables;
  }
};

/// Lays surfaces one after another, in the order of the calls of add().
class MemoryMap {
 public:
  explicit MemoryMap(uint64_t base) : next_(base) {}
  /// `most_table_bits`: of any frame of the surface.
  void add(uint32_t surface, const CompressedSurface& shape, uint64_t most_table_bits);
  bool has(uint32_t surface) const { return places_.contains(surface); }
  /// Precondition: has(surface).
  const SurfacePlace& place(uint32_t surface) const { return places_.at(surface); }
  const std::map<uint32_t, SurfacePlace>& places() const { return places_; }

 private:
  uint64_t next_;
  std::map<uint32_t, SurfacePlace> places_;
};

}  // namespace tilepress
