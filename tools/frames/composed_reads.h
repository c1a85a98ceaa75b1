// Composed reads: what composing moved, as CSV rows and as a table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frames/composition.h"

namespace tilepress {

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
