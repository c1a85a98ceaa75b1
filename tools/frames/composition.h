// Composition: several compressed surfaces read in one pass, as a display controller or compositor does
// (paper §Multi-Surface Support), and what that moved, as CSV rows and as a table.
#pragma once

#include <cstdint>
#include <string>
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
  std::vector<MemoryFetch> fetches;  ///< in their order, if the options ask for them
};

struct CompositionOptions {
  uint32_t width = 0, height = 0;  ///< screen, pixels
  bool skip_hidden = false;
  bool note_fetches = false;
  ReadOptions read;  ///< each surface has an rCCD and a CSB cache of its own
};

/// Reads each block that the screen needs once. Returns an entry per layer. An error names the layer by its
/// index.
Result<std::vector<LayerTraffic>> read_composition(const std::vector<Layer>& layers,
                                                   const CompositionOptions& options);

/// Sums over frames of what one layer, or all layers, moved.
struct ReadTotals {
  uint64_t blocks = 0, hidden = 0;
  uint64_t payload_bits = 0, csb_bits = 0, table_bits = 0, raw_bits = 0;
  uint64_t moved_bits() const { return payload_bits + csb_bits + table_bits; }
  double rate() const {
    return moved_bits() == 0 ? 0.0 : static_cast<double>(raw_bits) / static_cast<double>(moved_bits());
  }
  ReadTotals& operator+=(const ReadTotals& other);
};
ReadTotals totals_of(const LayerTraffic& layer, uint32_t burst_bits);

std::string composed_csv_header();
/// The row of one layer. `file`: where the layer comes from.
std::string composed_csv_row(uint64_t frame, size_t surface, const std::string& file, const Layer& layer,
                             const LayerTraffic& read);

struct ComposedSummary {
  std::vector<std::string> files;  ///< of the layers
  std::vector<ReadTotals> totals;  ///< of the layers
  uint64_t frames = 0;             ///< in the totals
  bool without_first = false;      ///< frame 0 is not in the totals
  double refresh_hz = 60;
};

/// The table for people: the read bandwidth of each layer and of all.
std::string composed_table(const ComposedSummary& summary, const CompositionOptions& options);

}  // namespace tilepress
