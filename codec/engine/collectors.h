// Collectors: the FVCs and dictionaries of a surface, and the frame meter; they see every pixel of a frame.
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

/// Configurations that differ in their period alone share a collector, and a dictionary while they have the
/// same one. With metrics, the collector of the default configuration comes first and serves the meter.
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
  /// Looks that block up. Its pixels are all `color`.
  void look_up_solid(uint32_t color) {
    for (const auto& dictionary : dictionaries_) dictionary->look_up_solid(color);
  }
  /// Feeds the FVCs with that block, whose pixels are not all equal: its `count` pixels inside the surface,
  /// of 64 at `pixels`.
  void see(const uint32_t* pixels, uint32_t count);
  /// Feeds the FVCs with `count` pixels of one colour.
  void see_solid(uint32_t color, uint32_t count) {
    if (run_.color != color) settle_run();
    run_.color = color;
    run_.count += count;
  }
  /// After the last pixel.
  void end_frame();
  /// After end_frame(). Returns zeros without metrics; with them, fills CcdView::collected.
  FrameMetrics metrics(const PixelPlane& plane, std::optional<uint64_t> changed);
  /// After end_frame(): builds the dictionaries for the next frames.
  void build_dictionaries();

  /// Calls visit(period) for each configuration.
  template <class Visit>
  void for_each_period(const Visit& visit) const {
    for (const auto& subscription : subscriptions_) visit(subscription->period);
  }

 private:
  struct Subscription {
    Collector* collector;
    uint32_t period;
    bool wanted = false;  ///< a scheme looks colours up
    std::shared_ptr<Dictionary> dictionary{};
    CcdView view{};
  };
  Subscription& subscribe(const FvcConfig& config);
  std::shared_ptr<Dictionary> unused_dictionary();
  bool due(const Subscription& subscription) const { return ordinal_ % subscription.period == 0; }
  void settle_run() {
    if (run_.count != 0) see_run();
  }
  void see_run();

  FormatTraits format_{};
  std::vector<std::unique_ptr<Collector>> collectors_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  FrameMeter meter_;
  bool with_metrics_ = false;
  std::vector<std::shared_ptr<Dictionary>> all_dictionaries_;  ///< in force or waiting to be used again

  // Of the frame at hand.
  uint64_t ordinal_ = 0;
  std::vector<Collector*> collecting_;
  std::vector<Dictionary*> dictionaries_;  ///< in force
  std::vector<Dictionary*> slow_;          ///< those that lookups_ leaves out
  SlotLookups lookups_;                    ///< what load() looks up at once
  bool meter_looks_ = false;               ///< the meter must see the pixels, since no collector reports them
  bool wants_runs_ = false;                ///< a collector uses SeenPixels::begins
  bool wants_few_ = false;                 ///< a look-up or the meter uses the colours of blocks of few

  FewColorSearch few_color_search_;
  const FewColors* few_ = nullptr;  ///< colours of the block loaded last; null: many or unknown
  /// A run of pixels of one colour that the collectors have not seen yet.
  struct {
    uint32_t color = 0, count = 0;
  } run_;
};

inline bool Collectors::load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  settle_run();  // a look-up must see the FVC as the block meets it
  const bool by_slots = slot_table_pays(0) || !lookups_.empty();
  const bool uniform = by_slots ? slot_kernels().load(top_left, stride, pixels, lookups_)
                                : pixel_kernels().load_traversal(top_left, stride, pixels);
  if (uniform) return true;
  few_ = wants_few_ ? few_color_search_.look(pixels) : nullptr;
  for (Dictionary* dictionary : slow_) dictionary->look_up(pixels, few_);
  return false;
}

inline void Collectors::see(const uint32_t* pixels, uint32_t count) {
  settle_run();
  const bool whole = count == kBlockPixels;
  if (meter_looks_) whole&& few_ != nullptr ? meter_.see_block(*few_) : meter_.see_all(pixels, count);
  const SeenPixels seen{.pixels = pixels,
                        .count = count,
                        .found = whole,
                        .few = whole ? few_ : nullptr,
                        .begins = wants_runs_ ? pixel_kernels().run_begins(pixels) : 0};
  for (Collector* collector : collecting_) collector->see(seen);
}

}  // namespace tilepress
