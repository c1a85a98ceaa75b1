// Composition: several compressed surfaces read in one pass, as a display controller or compositor does
// (paper §Multi-Surface Support).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"
#include "tilepress/surface_reader.h"

namespace tilepress {

/// Surfaces that contemporary engines composite in one pass (paper §Multi-Surface Composition).
constexpr size_t kMaxLayers = 16;

/// One surface on the screen. Layers are given from the bottom up.
struct Layer {
  CompressedSurface surface;
  int32_t x = 0, y = 0;  ///< of its top left pixel on the screen; may lie outside
  bool opaque() const {
    return surface.format == PixelFormat::kRgbx8 || surface.format == PixelFormat::kRgb565;
  }
};

/// What reading one layer took.
struct LayerTraffic {
  ReadTraffic traffic;
  uint64_t hidden_blocks = 0;   ///< left out: every pixel of theirs on the screen is below an opaque surface
  uint64_t outside_blocks = 0;  ///< left out: no pixel on the screen
};

struct CompositionOptions {
  uint32_t width = 0, height = 0;  ///< screen, pixels
  bool skip_hidden = false;
  ReadOptions read;  ///< of each surface: it has an rCCD and a CSB cache of its own
};

/// Reads each block that the screen needs once. `out` gets an entry per layer. False and one line in `error`
/// that names the layer by its index.
bool read_composition(const std::vector<Layer>& layers, const CompositionOptions& options,
                      std::vector<LayerTraffic>& out, std::string& error);

}  // namespace tilepress
