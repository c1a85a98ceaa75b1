// Model bounds: the first frame of a surface is warm-up, as it is for schemes.
#include "model_bounds.h"

#include <set>

#include "study/bounds/bound_coders.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {

Result<std::optional<ModelRows>> model_bounds(const FrameFeed& feed, const RunOptions& options,
                                              const std::atomic<int>& stop,
                                              std::atomic<uint64_t>& frames_done) {
  const std::vector<std::string>& names = bound_names();
  ModelRows rows;
  rows.schemes.assign(names.size(), schemes_csv_header());
  BoundCoders coders;
  PixelPlane plane;
  std::set<uint32_t> known;
  FrameStatistics statistics;
  FedFrame frame;
  while (stop == 0) {
    const auto fed = feed(frame);
    if (!fed) return fed.error();
    if (!*fed) return std::optional(std::move(rows));
    if (!options.takes(frame.frame)) continue;
    const bool is_new = known.insert(frame.surface).second;
    if (is_new && !has_bounds(frame.view.format))
      rows.skipped.push_back("surface " + std::to_string(frame.surface) + ": the bounds do not support " +
                             std::string(traits(frame.view.format).name));
    if (has_bounds(frame.view.format)) {
      statistics.frame = frame.frame;
      statistics.surface = frame.surface;
      statistics.warmup = is_new;
      plane.assign(frame.view);
      const auto measured = coders.measure(plane, options.model.burst_bits, statistics.schemes);
      if (!measured) return measured.error();
      append_texts_of_schemes(statistics, names, rows.schemes);
    }
    ++rows.frame_count;
    ++frames_done;
  }
  return std::optional<ModelRows>();
}

}  // namespace tilepress
