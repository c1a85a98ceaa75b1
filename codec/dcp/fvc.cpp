// Frequent Values Collector: lookup, insertion and the four replacement policies.
#include "dcp/fvc.h"

#include <algorithm>
#include <numeric>

namespace tilepress {
namespace {
constexpr uint32_t kRandomSeed = 0x9E3779B9u;
}

Fvc::Fvc(const FvcConfig& config, const FormatTraits& format)
    : config_(config),
      format_(format),
      ways_(config.ways_per_set()),
      sets_(config.entries / config.ways_per_set()),
      colors_(config.entries),
      counts_(config.entries),
      touched_(config.entries) {
  reset();
}

void Fvc::reset() {
  std::fill(counts_.begin(), counts_.end(), 0u);
  until_sample_ = 1;
  random_ = kRandomSeed;
  samples_ = 0;
}

uint64_t Fvc::held() const {
  return std::accumulate(counts_.begin(), counts_.end(), uint64_t{0});
}

uint32_t Fvc::first_slot(uint32_t color) const {
  uint32_t channels = 0;
  for (int c = 0; c < 4; ++c) channels ^= channel(format_, color, c);
  return channels % sets_ * ways_;
}

void Fvc::collect(uint32_t color) {
  ++samples_;
  const uint32_t first = sets_ == 1 ? 0 : first_slot(color);
  uint32_t empty = ways_;
  for (uint32_t way = 0; way < ways_; ++way) {
    if (counts_[first + way] == 0) {
      empty = way;  // slots fill in order and never empty again: nothing valid follows
      break;
    }
    if (colors_[first + way] == color) {
      ++counts_[first + way];
      touched_[first + way] = samples_;
      return;
    }
  }
  const uint32_t slot = empty < ways_ ? first + empty : victim(first);
  colors_[slot] = color;
  counts_[slot] = 1;
  touched_[slot] = samples_;
}

uint32_t Fvc::victim(uint32_t first) {
  const auto counts = counts_.begin() + first;
  switch (config_.policy) {
    case FvcPolicy::kLfc:
      return first + static_cast<uint32_t>(std::min_element(counts, counts + ways_) - counts);
    case FvcPolicy::k2Lfc: {
      if (ways_ == 1) return first;
      const auto smallest = std::min_element(counts, counts + ways_);
      auto second = smallest == counts ? counts + 1 : counts;
      for (auto it = counts; it != counts + ways_; ++it)
        if (it != smallest && *it < *second) second = it;
      return first + static_cast<uint32_t>(second - counts);
    }
    case FvcPolicy::kLru: {
      const auto touched = touched_.begin() + first;
      return first + static_cast<uint32_t>(std::min_element(touched, touched + ways_) - touched);
    }
    case FvcPolicy::kRandom:
      random_ ^= random_ << 13;
      random_ ^= random_ >> 17;
      random_ ^= random_ << 5;
      return first + random_ % ways_;
  }
  return first;
}

}  // namespace tilepress
