// Frame metrics: what is read off the colour histograms of a frame and the one before (spec §8).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dcp/lfc_collector.h"
#include "pixels/few_colors.h"
#include "statistics/color_distribution.h"
#include "statistics/color_histogram.h"
#include "tilepress/plane.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Fvc;

/// Frames of few colours are counted in hash tables that take an eighth of a raw frame together; frames of
/// many are distributed. Either way the colours are kept for the next frame.
class FrameMeter final : public ColorListener {
 public:
  /// Before the first pixel of a frame of `pixels`, all of which will be seen, in any order, each once.
  void begin_frame(size_t pixels);
  /// False: it makes no difference whether the pixels of this frame are seen.
  bool counting() const { return counting_; }
  void see_run(uint32_t color, uint32_t count) override {
    if (counting_ && !take(color, count)) counting_ = false;
  }
  void see_pixels(const uint32_t* pixels, uint32_t count, uint64_t alike) override;
  void see_all(const uint32_t* pixels, uint32_t count);
  void see_block(const FewColors& few);
  /// Measures `frame`, which has been seen. `changed`: its pixels that differ from those of the frame
  /// measured last, which had the same size; none if there was no such frame. `fvc` is the default FVC, fed
  /// with `frame`.
  FrameMetrics measure(const PixelPlane& frame, std::optional<uint64_t> changed, const Fvc& fvc);

 private:
  /// False: no room.
  bool take(uint32_t color, uint32_t count);
  bool flush();
  void count_few(bool compare, const Fvc& fvc);
  void count_many(const PixelPlane& frame, bool compare, const Fvc& fvc);

  ColorHistogram counts_;
  /// Most colours come back soon: here they wait before they go to the large table.
  struct RecentColor {
    uint32_t color, count;  ///< count 0: none
  };
  std::array<RecentColor, 2048> recent_{};
  bool counting_ = false;  ///< into counts_
  bool hashed_ = false;    ///< the colours measured last are in counts_; otherwise distributed
  bool many_ = false;      ///< colours are to be expected
  ColorDistribution distribution_;
  CountProfile profile_;
  ColorDistribution::Change change_;
};

}  // namespace tilepress
