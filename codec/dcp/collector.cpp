// Collector: chooses the form of the FVC that collects, and samples for it.
#include "dcp/collector.h"

#include "dcp/lfc_collector.h"
#include "dcp/run_collector.h"
#include "tilepress/simd.h"

namespace tilepress {

std::unique_ptr<FastFvc> make_fast_fvc(const FvcConfig& config, const FormatTraits& format) {
  if (simd_target() == "scalar") return nullptr;  // the definition
  if (config.policy == FvcPolicy::kLfc && config.ways_per_set() == config.entries && config.sample == 1) {
    if (slot_table_pays(config.entries)) return std::make_unique<LfcCollector<SlotMembers>>(config.entries);
    if (config.entries <= ProbeMembers::kMost)
      return std::make_unique<LfcCollector<ProbeMembers>>(config.entries);
  }
  return make_run_collector(config, format);
}

Collector::Collector(const FvcConfig& config, const FormatTraits& format)
    : fvc_(config, format), fast_(make_fast_fvc(config, format)), takes_all_(fast_ && config.sample == 1) {}

void Collector::begin_frame() {
  fvc_.reset();
  if (fast_) fast_->reset();
  until_sample_ = 1;
}

void Collector::see_run(uint32_t color, uint32_t count) {
  if (!fast_) return fvc_.see_run(color, count);
  if (takes_all_) return fast_->see_run(color, count);
  if (count < until_sample_) {
    until_sample_ -= count;
    return;
  }
  const uint32_t sample = fvc_.config().sample, behind_first = count - until_sample_;
  fast_->see_run(color, 1 + behind_first / sample);
  until_sample_ = sample - behind_first % sample;
}

void Collector::see(const SeenPixels& seen) {
  if (!fast_) return fvc_.see_all(seen.pixels, seen.count);
  if (takes_all_) return fast_->see(seen);
  uint32_t at = until_sample_;  // behind the next pixel to take
  while (at <= seen.count) {
    const uint32_t color = seen.pixels[at - 1];
    uint32_t count = 0;
    for (; at <= seen.count && seen.pixels[at - 1] == color; at += fvc_.config().sample) ++count;
    fast_->see_run(color, count);
  }
  until_sample_ = at - seen.count;
}

}  // namespace tilepress
