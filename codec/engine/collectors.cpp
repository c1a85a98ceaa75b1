// Collectors: the beginning and the end of a frame, and runs of one colour.
#include "engine/collectors.h"

namespace tilepress {

void Collectors::open(const FormatTraits& format, bool with_metrics) {
  format_ = format;
  with_metrics_ = with_metrics;
  if (with_metrics) collector_of(FvcConfig{});
}

Collector& Collectors::collector_of(const FvcConfig& config) {
  for (const auto& collector : collectors_)
    if (collector->fvc().config() == config) return *collector;
  return *collectors_.emplace_back(std::make_unique<Collector>(config, format_));
}

const CcdView& Collectors::view_of(const FvcConfig& config) {
  Collector& collector = collector_of(config);
  collector.wanted = true;
  return collector.view();
}

void Collectors::begin(uint64_t ordinal, size_t pixels) {
  loads_slots_ = slot_kernels().byte_permutes && !collectors_.empty();
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
