// Collectors: what happens once a frame, or for a run of blocks of one colour.
#include "collectors.h"

namespace tilepress {

Collector& Collectors::of(const FvcConfig& config, const FormatTraits& format) {
  for (const auto& collector : collectors_)
    if (collector->fvc().config() == config) return *collector;
  return *collectors_.emplace_back(std::make_unique<Collector>(config, format));
}

void Collectors::open(bool with_metrics) {
  with_metrics_ = with_metrics;
  loads_slots_ = slot_kernels().byte_permutes && !collectors_.empty();
}

void Collectors::begin_frame(uint64_t ordinal, size_t pixels) {
  for (const auto& collector : collectors_) collector->begin_frame(ordinal);
  meter_looks_ = false;
  if (with_metrics_) {
    meter_.begin_frame(pixels);
    meter_looks_ = meter_.counting() && !collectors_.front()->listen(&meter_);
  }
  wants_few_ = meter_looks_ || (!loads_slots_ && !collectors_.empty());
}

void Collectors::see_run() {
  for (const auto& collector : collectors_) collector->see_run(run_.color, run_.count);
  if (meter_looks_) meter_.see_run(run_.color, run_.count);
  run_.count = 0;
}

void Collectors::end_frame() {
  settle_run();
  for (const auto& collector : collectors_) collector->end_frame();
}

FrameMetrics Collectors::metrics(const PixelPlane& plane, std::optional<uint64_t> changed) {
  return with_metrics_ ? meter_.measure(plane, changed, collectors_.front()->fvc()) : FrameMetrics{};
}

void Collectors::build_ccds() {
  for (const auto& collector : collectors_)
    if (collector->wanted) collector->build_ccd();
}

}  // namespace tilepress
