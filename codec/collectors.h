// Collectors: those of every FVC configuration in use, and the frame meter; each sees every pixel of a frame.
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

class Collectors {
 public:
  /// Before the first frame: the collector of a configuration, made if there is none yet.
  Collector& of(const FvcConfig& config, const FormatTraits& format);
  /// After that: with_metrics = the first collector's frames are metered, too.
  void open(bool with_metrics);

  /// `pixels`: of the frame, padding included.
  void begin_frame(uint64_t ordinal, size_t pixels);
  /// The next block, of the padded plane, to traversal order; and looks its pixels up where a CCD is wanted.
  /// True if they are all equal.
  bool load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);
  /// That block is all equal, and its colour has not been looked up in this frame.
  void look_up_solid(const uint32_t* pixels) { look_up(pixels, true, 0); }
  /// Of that block, which is not all equal, the `count` pixels that lie inside the surface.
  void see(const uint32_t* pixels, uint32_t count);
  /// `count` pixels of one colour.
  void see_solid(uint32_t color, uint32_t count) {
    if (run_.color != color) settle_run();
    run_.color = color;
    run_.count += count;
  }
  /// After the last pixel.
  void end_frame();
  /// After end_frame(). Without metrics: none.
  FrameMetrics metrics(const PixelPlane& plane, std::optional<uint64_t> changed);
  /// After end_frame(): dictionaries for the frames after it.
  void build_ccds();

  auto begin() const { return collectors_.begin(); }
  auto end() const { return collectors_.end(); }

 private:
  void look_up(const uint32_t* pixels, bool uniform, size_t first);
  void settle_run() {
    if (run_.count != 0) see_run();
  }
  void see_run();
  std::vector<std::unique_ptr<Collector>> collectors_;
  FrameMeter meter_;
  bool with_metrics_ = false;
  bool meter_looks_ = false;  ///< the meter has to see the pixels, and no collector tells it
  bool loads_slots_ = false;  ///< the first collector loads blocks, and looks them up at once
  bool wants_few_ = false;    ///< a collector makes use of few colours, or the meter does
  FewColorSearch few_color_search_;
  const FewColors* few_ = nullptr;  ///< colours of the block loaded last; null: not known to be few
  /// Pixels of one colour in a row that the collectors have not seen yet.
  struct {
    uint32_t color = 0, count = 0;
  } run_;
};

inline bool Collectors::load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  bool uniform;
  if (loads_slots_) {
    settle_run();  // so that the members are those the block meets
    uniform = collectors_.front()->load(top_left, stride, pixels);
  } else {
    uniform = pixel_kernels().load_traversal(top_left, stride, pixels);
  }
  if (uniform) return true;
  few_ = wants_few_ ? few_color_search_.look(pixels) : nullptr;
  look_up(pixels, false, loads_slots_ ? 1 : 0);
  return false;
}

/// By the collectors from number `first` on.
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
