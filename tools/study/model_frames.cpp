// Model frames: an engine per surface.
#include "model_frames.h"

#include <map>

#include "study/color_shares.h"
#include "tilepress/scheme.h"
#include "tilepress/statistics_rows.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

void append_texts_of_schemes(const FrameStatistics& frame, const std::vector<std::string>& names,
                             std::vector<std::string>& texts) {
  FrameStatistics one = frame;
  for (size_t i = 0; i < names.size(); ++i) {
    one.schemes.assign(1, frame.schemes[i]);
    append_schemes_rows(one, {names[i]}, texts[i]);
  }
}

Result<std::optional<ModelRows>> model_frames(const FrameFeed& feed, const RunOptions& options,
                                              bool with_colors, const std::atomic<int>& stop,
                                              std::atomic<uint64_t>& frames_done) {
  ModelRows rows;
  rows.schemes.assign(options.schemes.size(), schemes_csv_header());
  rows.frames = frames_csv_header();
  std::vector<std::string> names;
  for (const SchemeSpec& spec : options.schemes) names.push_back(spec.text);
  ColorShares colors;
  std::map<uint32_t, SurfaceEngine> engines;
  FrameStatistics statistics;
  FedFrame frame;
  while (stop == 0) {
    const auto fed = feed(frame);
    if (!fed) return fed.error();
    if (!*fed) {
      rows.colors = colors.text();
      return std::optional(std::move(rows));
    }
    if (!options.takes(frame.frame)) continue;
    const auto [engine, is_new] = engines.try_emplace(frame.surface, options.schemes, options.model);
    if (is_new)
      for (const std::string& line : unsupported_schemes(options.schemes, frame.view.format))
        rows.skipped.push_back("surface " + std::to_string(frame.surface) + ": " + line);
    statistics.frame = frame.frame;
    statistics.surface = frame.surface;
    statistics.time_ns = frame.time_ns;
    statistics.readback_ns = frame.readback_ns;
    engine->second.process(frame.view, statistics);
    append_frames_row(statistics, rows.frames);
    append_texts_of_schemes(statistics, names, rows.schemes);
    if (with_colors && !statistics.warmup) colors.add(frame.view);
    ++rows.frame_count;
    ++frames_done;
  }
  return std::optional<ModelRows>();
}

}  // namespace tilepress
