// Collector: chooses the form of the FVC that collects.
#include "dcp/collector.h"

#include "tilepress/simd.h"

namespace tilepress {

Collector::Collector(const FvcConfig& config, const FormatTraits& format) : fvc_(config, format) {
  if (config.policy == FvcPolicy::kLfc && config.ways == 0 && config.sample == 1 &&
      config.entries <= LfcCollector::kMaxEntries && simd_target() != "scalar")
    fast_ = std::make_unique<LfcCollector>(config.entries);
}

void Collector::begin_frame(uint64_t ordinal) {
  collecting_ = ordinal % fvc_.config().period == 0;
  lookups_ = {.dictionary = wanted && ccd() != nullptr ? lookup_.slots() : nullptr,
              .indices = indices_.data(),
              .widths = widths_.data(),
              .members = collecting_ && fast_ ? fast_->members() : nullptr,
              .slots = slots_.data(),
              .found = {}};
  if (!collecting_) return;
  fvc_.reset();
  if (fast_) fast_->reset();
}

bool Collector::listen(ColorListener* listener) {
  if (!collecting_ || !fast_) return false;
  fast_->listen(listener);
  return true;
}

void Collector::see_run(uint32_t color, uint32_t count) {
  if (!collecting_) return;
  fast_ ? fast_->see_run(color, count) : fvc_.see_run(color, count);
}

void Collector::see_all(const uint32_t* pixels, uint32_t count, const FewColors* few) {
  if (!collecting_) return;
  if (!fast_) {
    fvc_.see_all(pixels, count);
  } else if (count < kBlockPixels) {
    for (uint32_t i = 0; i < count; ++i) fast_->see_run(pixels[i], 1);
  } else if (has_found_) {
    fast_->see_found(pixels, lookups_.found, slots_.data());
  } else if (few == nullptr || !fast_->see_block(*few)) {
    fast_->see_block(pixels);
  }
}

void Collector::end_frame() {
  if (!collecting_ || !fast_) return;
  fast_->tell_held();
  fast_->store_to(fvc_);
}

void Collector::build_ccd() {
  if (!collecting_) return;
  ccd_.build(fvc_);
  lookup_.build(ccd_);
  view_.ccd = &ccd_;
}

void Collector::look_up(const uint32_t* pixels, bool uniform, const FewColors* few) {
  if (uniform) {
    const uint16_t index = lookup_.find(pixels[0]);
    indices_.fill(index);
    widths_.fill(width_of(index));
  } else if (few != nullptr) {
    lookup_.find_block(pixels, *few, indices_.data(), widths_.data());
  } else {
    lookup_.find_block(pixels, indices_.data(), widths_.data());
  }
}

bool Collector::load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  const bool uniform = slot_kernels().load(top_left, stride, pixels, lookups_);
  has_found_ = !uniform && lookups_.members != nullptr;
  if (!uniform && wanted && ccd() != nullptr && lookups_.dictionary == nullptr)
    look_up(pixels, false, nullptr);
  return uniform;
}

}  // namespace tilepress
