// Composition: several compressed surfaces read in one pass, as a display controller or compositor does
// (paper §Multi-Surface Support).
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/compressed_surface.h"
#include "tilepress/surface_reader.h"

namespace tilepress {

/// Surfaces that today's display engines composite in one pass (paper §Multi-Surface Composition).
constexpr size_t kMaxLayers = 16;

/// One surface on the screen. Layers stand in a list from the bottom up.
struct Layer {
  CompressedSurface surface;
  uint32_t number = 0;   ///< of the surface in its file
  int32_t x = 0, y = 0;  ///< place of its top left pixel on the screen; may lie outside
  bool opaque() const {
    return surface.format == PixelFormat::kRgbx8 || surface.format == PixelFormat::kRgb565;
  }
};

/// The reads of one layer.
struct LayerTraffic {
  ReadTraffic traffic;
  uint64_t hidden_blocks = 0;   ///< not read: all their pixels on the screen are below an opaque surface
  uint64_t outside_blocks = 0;  ///< not read: they have no pixel on the screen
};

struct CompositionOptions {
  uint32_t width = 0, height = 0;  ///< screen, pixels
  bool skip_hidden = false;
  ReadOptions read;  ///< each surface has an rCCD and a CSB cache of its own
};

/// Reads each block that the screen needs once. Returns an entry per layer. An error names the layer by its
/// index.
Result<std::vector<LayerTraffic>> read_composition(const std::vector<Layer>& layers,
                                                   const CompositionOptions& options);

}  // namespace tilepress
