// Run pictures: thumbnails and heat maps of a run's kept frames, as data URIs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/run_reader.h"

namespace tilepress {

struct HeatMap {
  std::string scheme;
  std::string image;  ///< data URI of a PNG, a pixel per block
  uint32_t raw_bits = 0, most_bits = 0;
  double mean_bits = 0;
};

struct RunPicture {
  uint64_t frame = 0;
  uint32_t surface = 0;
  uint32_t width = 0, height = 0;  ///< of the pictures on the page, pixels
  std::string thumbnail;           ///< data URI; empty if the frame's pixels were not kept
  std::vector<HeatMap> heat_maps;  ///< in the order of the run's schemes
};

/// Up to `max_count` of the frames that have pictures, spread evenly over the run. Skips files that are no
/// pictures, and frames without rows.
std::vector<RunPicture> load_pictures(const RunRecord& run, size_t max_count);

/// The colours of heat maps as SVG gradient stops, from 0 to raw.
std::string heat_scale_stops();

}  // namespace tilepress
