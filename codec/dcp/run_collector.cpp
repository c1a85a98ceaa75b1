// Run collector: large sets by a colour map, small sets by comparing all ways.
#include "dcp/run_collector.h"

#include <algorithm>
#include <array>
#include <utility>

#include "cpu/bit_count.h"
#include "cpu/mask_runs.h"
#include "dcp/fvc.h"
#include "dcp/fvc_slots.h"
#include "pixels/pixel_kernels.h"

namespace tilepress {
namespace {

/// Base: sets and slots. `Self` has take(color, count).
template <class Self>
class RunCollector : public FastFvc {
 public:
  RunCollector(const FvcConfig& config, const FormatTraits& format)
      : format_(format), slots_(config.entries, config.ways_per_set()) {}
  void see_run(uint32_t color, uint32_t count) final {
    samples_ += count;
    static_cast<Self*>(this)->take(color, count);
  }
  void see(const SeenPixels& seen) override {
    for_each_mask_run(seen.begins & ~uint64_t{0} >> (kBlockPixels - seen.count), seen.count,
                      [&](uint32_t first, uint32_t count) { see_run(seen.pixels[first], count); });
  }
  bool wants_runs() const final { return true; }
  void listen(ColorListener* listener) final { slots_.listener = listener; }
  void store_to(Fvc& fvc) final {
    for (uint32_t slot = 0; slot < slots_.colors.size(); ++slot) {
      slots_.tell(slot);
      fvc.set_slot(slot, slots_.colors[slot], slots_.counts[slot]);
    }
    slots_.listener = nullptr;
    fvc.set_samples(samples_);
  }

 protected:
  /// Sets are a power of two.
  uint32_t set_of(uint32_t color) const {
    if (slots_.used.size() == 1) return 0;
    uint32_t channels = color ^ color >> 16;
    channels = (channels ^ channels >> 8) & 0xFF;
    if (!has_bytes_) {
      channels = 0;
      for (int c = 0; c < 4; ++c) channels ^= channel(format_, color, c);
    }
    return channels & (static_cast<uint32_t>(slots_.used.size()) - 1);
  }
  const FormatTraits format_;
  const bool has_bytes_ = format_.channel_bits == traits(PixelFormat::kRgba8).channel_bits;
  uint64_t samples_ = 0;
  FvcSlots slots_;
};

template <class Order>
class MapCollector : public RunCollector<MapCollector<Order>> {
 public:
  MapCollector(const FvcConfig& config, const FormatTraits& format)
      : RunCollector<MapCollector>(config, format), map_(config.entries), order_(this->slots_, map_) {
    reset();
  }
  void reset() override {
    this->samples_ = 0;
    this->slots_.clear();
    map_.clear();
    order_.reset();
  }
  void take(uint32_t color, uint32_t count) {
    const uint32_t slot = map_.find(color);
    if (slot == ColorMap::kAbsent) return miss(color, count);
    this->slots_.counts[slot] += count;
    order_.hit(slot);
  }

 protected:
  void miss(uint32_t color, uint32_t count) {
    FvcSlots& slots = this->slots_;
    const uint32_t set = this->set_of(color);
    if (slots.used[set] == slots.ways) return order_.miss(set, color, count);
    const uint32_t slot = set * slots.ways + slots.used[set]++;
    slots.put(slot, color, count);
    map_.insert(color, slot);
    order_.fill(slot);
  }
  ColorMap map_;
  Order order_;
};

/// One set, where few of the pixels change the map: looks up a block of many runs at once, and visits only
/// its misses one by one.
template <uint32_t kTails>
class LeastFrequentCollector final : public MapCollector<LeastFrequentOrder<kTails>> {
 public:
  using MapCollector<LeastFrequentOrder<kTails>>::MapCollector;
  void see(const SeenPixels& seen) override {
    constexpr uint32_t kFewRuns = 16;
    const bool full = this->slots_.used[0] == this->slots_.ways;
    if (!full || seen.count < kBlockPixels || bit_count(seen.begins) <= kFewRuns)
      return MapCollector<LeastFrequentOrder<kTails>>::see(seen);
    this->samples_ += kBlockPixels;
    if (seen.few != nullptr && take_few(*seen.few)) return;
    for (uint32_t from = 0; from < kBlockPixels;) from = take_from(seen.pixels, from);
  }

 private:
  /// Returns false, and takes nothing, if the map lacks one of the colours.
  bool take_few(const FewColors& few) {
    uint32_t slots[FewColors::kMost];
    for (uint32_t n = 0; n < few.count; ++n) {
      slots[n] = this->map_.find(few.colors[n]);
      if (slots[n] == ColorMap::kAbsent) return false;
    }
    for (uint32_t n = 0; n < few.count; ++n) this->slots_.counts[slots[n]] += bit_count(few.places[n]);
    return true;
  }
  /// Takes pixels from number `from` on until the map changes. Returns the number of the next.
  uint32_t take_from(const uint32_t* pixels, uint32_t from) {
    std::array<uint32_t, kBlockPixels> found;
    uint64_t misses = 0;
    for (uint32_t i = from; i < kBlockPixels; ++i) {
      found[i] = this->map_.find(pixels[i]);
      misses |= uint64_t{found[i] == ColorMap::kAbsent} << i;
    }
    uint64_t hits = ~misses & ~uint64_t{0} << from;
    const auto count_to = [&](uint32_t end) {
      for (; hits != 0; hits &= hits - 1) {
        const auto at = static_cast<uint32_t>(std::countr_zero(hits));
        if (at >= end) return;
        ++this->slots_.counts[found[at]];
      }
    };
    if (misses == 0 || this->order_.touch_all(0, pixels, misses, [&](uint32_t color) {
          return pixel_kernels().places_of(pixels, color);
        }))
      misses = 0;
    for (; misses != 0; misses &= misses - 1) {
      const auto at = static_cast<uint32_t>(std::countr_zero(misses));
      if (!this->order_.touch(0, pixels[at], 1)) continue;
      count_to(at + 1);
      if (this->order_.settle(0)) return at + 1;
    }
    count_to(kBlockPixels);
    return kBlockPixels;
  }
};

/// Sets of `kWays` ways, as Fvc has them.
template <uint32_t kWays>
class SmallSetCollector final : public RunCollector<SmallSetCollector<kWays>> {
 public:
  SmallSetCollector(const FvcConfig& config, const FormatTraits& format)
      : RunCollector<SmallSetCollector>(config, format), policy_(config.policy), touched_(config.entries) {
    reset();
  }
  void reset() override {
    this->samples_ = 0;
    this->slots_.clear();
    random_.reset();
  }
  void take(uint32_t color, uint32_t count) {
    FvcSlots& slots = this->slots_;
    const uint32_t set = this->set_of(color), first = set * kWays;
    uint32_t same = 0;
    for (uint32_t way = 0; way < kWays; ++way) same |= uint32_t{slots.colors[first + way] == color} << way;
    same &= (1u << slots.used[set]) - 1;
    uint32_t slot;
    if (same != 0) {
      slot = first + static_cast<uint32_t>(std::countr_zero(same));
      slots.counts[slot] += count;
    } else {
      slot = first + (slots.used[set] < kWays ? slots.used[set]++ : victim(&slots.counts[first], first));
      slots.put(slot, color, count);
    }
    if (policy_ == FvcPolicy::kLru) touched_[slot] = this->samples_;
  }

 private:
  uint32_t victim(const uint32_t* counts, uint32_t first) {
    const auto smallest = [](const auto* values) {
      uint64_t best = ~uint64_t{0};  // by (value, way), without a branch
      for (uint32_t way = 0; way < kWays; ++way) best = std::min(best, values[way] * uint64_t{kWays} + way);
      return static_cast<uint32_t>(best % kWays);
    };
    if (policy_ == FvcPolicy::kRandom) return random_.next() % kWays;
    if (policy_ == FvcPolicy::kLru) return smallest(&touched_[first]);
    if (policy_ == FvcPolicy::kLfc || kWays == 1) return smallest(counts);
    std::array<uint32_t, kWays> others;
    std::copy_n(counts, kWays, others.begin());
    others[smallest(counts)] = ~0u;
    return smallest(others.data());
  }
  const FvcPolicy policy_;
  std::vector<uint64_t> touched_;  ///< by slot: the samples at its last hit or insertion, for lru
  Xorshift32 random_;
};

template <uint32_t kTails>
std::unique_ptr<FastFvc> make_least_frequent(const FvcConfig& config, const FormatTraits& format) {
  if (config.ways_per_set() == config.entries)
    return std::make_unique<LeastFrequentCollector<kTails>>(config, format);
  return std::make_unique<MapCollector<LeastFrequentOrder<kTails>>>(config, format);
}

}  // namespace

std::unique_ptr<FastFvc> make_run_collector(const FvcConfig& config, const FormatTraits& format) {
  switch (config.ways_per_set()) {
    case 1:
      return std::make_unique<SmallSetCollector<1>>(config, format);
    case 2:
      return std::make_unique<SmallSetCollector<2>>(config, format);
    case 4:
      return std::make_unique<SmallSetCollector<4>>(config, format);
    case 8:
      return std::make_unique<SmallSetCollector<8>>(config, format);
    default:
      break;
  }
  switch (config.policy) {
    case FvcPolicy::kLfc:
      return make_least_frequent<1>(config, format);
    case FvcPolicy::k2Lfc:
      return make_least_frequent<2>(config, format);
    case FvcPolicy::kLru:
      return std::make_unique<MapCollector<LeastRecentOrder>>(config, format);
    case FvcPolicy::kRandom:
      break;
  }
  return std::make_unique<MapCollector<RandomOrder>>(config, format);
}

}  // namespace tilepress
