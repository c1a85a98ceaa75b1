// Frequent Values Collector: a small associative memory that counts colours (paper §The FVC).
#pragma once

#include <cstdint>
#include <vector>

#include "dcp/fvc_config.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

/// The definition of an FVC, by plain scans.
class Fvc {
 public:
  Fvc(const FvcConfig& config, const FormatTraits& format);

  /// Takes `count` pixels of the frame in a row.
  void see_all(const uint32_t* pixels, uint32_t count) {
    while (until_sample_ <= count) {
      pixels += until_sample_;
      count -= until_sample_;
      until_sample_ = config_.sample;
      collect(pixels[-1]);
    }
    until_sample_ -= count;
  }
  /// The same for `count` pixels of one colour.
  void see_run(uint32_t color, uint32_t count) {
    for (; count >= until_sample_; collect(color)) {
      count -= until_sample_;
      until_sample_ = config_.sample;
    }
    until_sample_ -= count;
  }
  /// Empties the FVC, at the start of each frame that it collects.
  void reset();
  /// Takes the state of a faster collector: a slot (count 0 = empty), and the pixels that entered.
  void set_slot(uint32_t slot, uint32_t color, uint32_t count) {
    colors_[slot] = color;
    counts_[slot] = count;
  }
  void set_samples(uint64_t samples) { samples_ = samples; }

  const FvcConfig& config() const { return config_; }
  uint32_t slots() const { return config_.entries; }
  bool valid(uint32_t slot) const { return counts_[slot] != 0; }
  uint32_t color(uint32_t slot) const { return colors_[slot]; }
  uint32_t count(uint32_t slot) const { return counts_[slot]; }
  /// Returns the number of the sample, from 1, that hit or filled the slot last.
  uint64_t last(uint32_t slot) const { return touched_[slot]; }
  /// 1 = the next pixel enters, 2 = the pixel after it, ...
  uint32_t until_sample() const { return until_sample_; }
  /// The xorshift32 register of FvcPolicy::kRandom.
  uint32_t random_register() const { return random_; }
  /// Returns the pixels that entered since reset().
  uint64_t samples() const { return samples_; }
  /// Returns the sum of all counts.
  uint64_t held() const;
  double coverage() const { return samples_ == 0 ? 0.0 : static_cast<double>(held()) / samples_; }

 private:
  void collect(uint32_t color);
  uint32_t first_slot(uint32_t color) const;
  uint32_t victim(uint32_t first);

  FvcConfig config_;
  FormatTraits format_;
  uint32_t ways_, sets_;
  uint32_t until_sample_ = 1;
  uint32_t random_ = 0;
  uint64_t samples_ = 0;
  std::vector<uint32_t> colors_, counts_;
  std::vector<uint64_t> touched_;  ///< sample number of the last hit or insertion, for lru
};

}  // namespace tilepress
