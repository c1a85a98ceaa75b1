// Collectors: one per FVC configuration in use, and the frame meter; each sees every pixel of a frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dcp/collector.h"
#include "pixels/few_color_search.h"
#include "pixels/pixel_kernels.h"
#include "statistics/frame_metrics.h"

namespace tilepress {

/// With metrics, the collector of the default configuration comes first and serves the meter.
class Collectors final : public CcdSource {
 public:
  /// Before the first frame.
  void open(const FormatTraits& format, bool with_metrics);
  /// After open(): subscribes to the dictionary of a configuration.
  const CcdView& view_of(const FvcConfig& config) override;

  /// Begins a frame. `pixels` counts the pixels of the frame inside the surface.
  void begin(uint64_t ordinal, size_t pixels);
  /// Copies the next block out of the padded plane into traversal order, and looks its pixels up in the CCDs
  /// unless they are all equal. Returns true if they are.
  bool load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);
  /// Looks that block up. Its pixels are all equal.
  void look_up_solid(const uint32_t* pixels) { look_up(pixels, true, 0); }
  /// Feeds the FVCs with that block, whose pixels are not all equal: its `count` pixels inside the surface.
  void see(const uint32_t* pixels, uint32_t count);
  /// Feeds the FVCs with `count` pixels of one colour.
  void see_solid(uint32_t color, uint32_t count) {
    if (run_.color != color) settle_run();
    run_.color = color;
    run_.count += count;
  }
  /// After the last pixel.
  void end_frame();
  /// After end_frame(). Returns zeros without metrics.
  FrameMetrics metrics(const PixelPlane& plane, std::optional<uint64_t> changed);
  /// After end_frame(): builds the dictionaries for the next frames.
  void build_ccds();

  const std::vector<std::unique_ptr<Collector>>& all() const { return collectors_; }

 private:
  Collector& collector_of(const FvcConfig& config);
  void look_up(const uint32_t* pixels, bool uniform, size_t first);
  void settle_run() {
    if (run_.count != 0) see_run();
  }
  void see_run();
  FormatTraits format_{};
  std::vector<std::unique_ptr<Collector>> collectors_;
  FrameMeter meter_;
  bool with_metrics_ = false;
  bool meter_looks_ = false;  ///< the meter must see the pixels, since no collector reports them
  bool loads_slots_ = false;  ///< the first collector loads blocks, and looks them up at once
  bool wants_few_ = false;    ///< a collector or the meter uses the colours of blocks of few
  FewColorSearch few_color_search_;
  const FewColors* few_ = nullptr;  ///< colours of the block loaded last; null: many or unknown
  /// A run of pixels of one colour that the collectors have not seen yet.
  struct {
    uint32_t color = 0, count = 0;
  } run_;
};

inline bool Collectors::load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  bool uniform;
  if (loads_slots_) {
    settle_run();  // the look-up must see the FVC as the block meets it
    uniform = collectors_.front()->load(top_left, stride, pixels);
  } else {
    uniform = pixel_kernels().load_traversal(top_left, stride, pixels);
  }
  if (uniform) return true;
  few_ = wants_few_ ? few_color_search_.look(pixels) : nullptr;
  look_up(pixels, false, loads_slots_ ? 1 : 0);
  return false;
}

/// The collectors from number `first` on look the block up.
inline void Collectors::look_up(const uint32_t* pixels, bool uniform, size_t first) {
  for (size_t i = first; i < collectors_.size(); ++i)
    if (collectors_[i]->wanted && collectors_[i]->ccd() != nullptr)
      collectors_[i]->look_up(pixels, uniform, uniform ? nullptr : few_);
}

inline void Collectors::see(const uint32_t* pixels, uint32_t count) {
  settle_run();
  const FewColors* whole_few = count == kBlockPixels ? few_ : nullptr;
  if (meter_looks_) whole_few != nullptr ? meter_.see_block(*whole_few) : meter_.see_all(pixels, count);
  for (const auto& collector : collectors_) collector->see_all(pixels, count, whole_few);
}

}  // namespace tilepress
