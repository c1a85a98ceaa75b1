// Collectors: the beginning and the end of a frame, and runs of one colour.
#include "engine/collectors.h"

#include <algorithm>

namespace tilepress {

void Collectors::open(const FormatTraits& format, bool with_metrics) {
  format_ = format;
  with_metrics_ = with_metrics;
  if (with_metrics) subscribe(FvcConfig{});
}

Collectors::Subscription& Collectors::subscribe(const FvcConfig& config) {
  FvcConfig every_frame = config;
  every_frame.period = 1;
  Collector* found = nullptr;
  for (const auto& each : collectors_)
    if (each->fvc().config() == every_frame) found = each.get();
  if (found == nullptr)
    found = collectors_.emplace_back(std::make_unique<Collector>(every_frame, format_)).get();
  for (const auto& each : subscriptions_)
    if (each->collector == found && each->period == config.period) return *each;
  return *subscriptions_.emplace_back(
      std::make_unique<Subscription>(Subscription{.collector = found, .period = config.period}));
}

const CcdView& Collectors::view_of(const FvcConfig& config) {
  Subscription& subscription = subscribe(config);
  subscription.wanted = true;
  return subscription.view;
}

void Collectors::begin(uint64_t ordinal, size_t pixels) {
  ordinal_ = ordinal;
  collecting_.clear();
  dictionaries_.clear();
  slow_.clear();
  lookups_ = {};
  wants_runs_ = false;
  const auto add = [](auto& list, auto* each) {
    if (std::find(list.begin(), list.end(), each) == list.end()) list.push_back(each);
  };
  for (const auto& subscription : subscriptions_) {
    if (due(*subscription)) add(collecting_, subscription->collector);
    if (subscription->dictionary != nullptr) add(dictionaries_, subscription->dictionary.get());
  }
  for (Collector* collector : collecting_) {
    collector->begin_frame();
    wants_runs_ |= collector->wants_runs();
    if (MemberLookup* lookup = collector->lookup()) lookups_.members.push_back(lookup);
  }
  for (Dictionary* each : dictionaries_)
    if (each->lookup.slots() != nullptr)
      lookups_.dictionaries.push_back({each->lookup.slots(), each->indices.data(), each->widths.data()});
    else
      slow_.push_back(each);
  meter_looks_ = false;
  if (with_metrics_) {
    meter_.begin_frame(pixels);
    meter_looks_ = meter_.counting() && !collectors_.front()->listen(&meter_);
  }
  wants_few_ = meter_looks_ || wants_runs_ || !slow_.empty();
}

void Collectors::see_run() {
  for (Collector* collector : collecting_) collector->see_run(run_.color, run_.count);
  if (meter_looks_) meter_.see_run(run_.color, run_.count);
  run_.count = 0;
}

void Collectors::end_frame() {
  settle_run();
  for (Collector* collector : collecting_) collector->end_frame();
}

FrameMetrics Collectors::metrics(const PixelPlane& plane, std::optional<uint64_t> changed) {
  if (!with_metrics_) return {};
  // The collector of the default configuration collects every frame, before all others.
  std::vector<const Fvc*> fvcs;
  for (const Collector* collector : collecting_) fvcs.push_back(&collector->fvc());
  const FrameMetrics metrics = meter_.measure(plane, changed, fvcs);
  for (const auto& each : subscriptions_) {
    const auto at = std::ranges::find(collecting_, each->collector) - collecting_.begin();
    each->view.collected.reset();
    if (due(*each)) each->view.collected = meter_.figures_of(static_cast<size_t>(at));
  }
  return metrics;
}

/// Returns a dictionary that no subscription has.
std::shared_ptr<Dictionary> Collectors::unused_dictionary() {
  for (const auto& each : all_dictionaries_)
    if (each.use_count() == 1) return each;
  return all_dictionaries_.emplace_back(std::make_shared<Dictionary>());
}

void Collectors::build_dictionaries() {
  for (Collector* collector : collecting_) {
    std::shared_ptr<Dictionary> fresh;
    for (const auto& each : subscriptions_) {
      if (each->collector != collector || !each->wanted || !due(*each)) continue;
      if (fresh == nullptr) {
        fresh = unused_dictionary();
        fresh->build(collector->fvc());
      }
      each->dictionary = fresh;
      each->view.ccd = &fresh->ccd;
      each->view.indices = fresh->indices.data();
      each->view.widths = fresh->widths.data();
    }
  }
}

}  // namespace tilepress
