// FVC follower: an Fvc and a Ccd, frame by frame.
#include "tilepress/fvc_follower.h"

#include <algorithm>
#include <utility>

#include "dcp/ccd.h"
#include "dcp/fvc.h"

namespace tilepress {

struct FvcFollower::State {
  Fvc fvc;
  Ccd ccd{};
  bool collecting = false;
};

std::optional<FvcFollower> FvcFollower::make(const SchemeSpec& scheme, PixelFormat format) {
  const SchemeInfo* info = find_scheme(scheme.name);
  const auto fvc_keys = std::span(kDcpKeys).first(kFvcKeys);
  const bool has_fvc = info != nullptr && info->keys.size() >= kFvcKeys &&
                       std::equal(fvc_keys.begin(), fvc_keys.end(), info->keys.begin(),
                                  [](const SchemeKey& a, const SchemeKey& b) { return a.name == b.name; });
  if (!has_fvc) return std::nullopt;
  return FvcFollower(std::make_unique<State>(State{Fvc(fvc_config(scheme), traits(format))}));
}

FvcFollower::FvcFollower(std::unique_ptr<State> state) : state_(std::move(state)) {}
FvcFollower::FvcFollower(FvcFollower&&) noexcept = default;
FvcFollower& FvcFollower::operator=(FvcFollower&&) noexcept = default;
FvcFollower::~FvcFollower() = default;

uint32_t FvcFollower::entries() const {
  return state_->fvc.slots();
}

bool FvcFollower::uses_last() const {
  return state_->fvc.config().policy == FvcPolicy::kLru;
}

bool FvcFollower::collects(uint64_t ordinal) const {
  return ordinal % state_->fvc.config().period == 0;
}

void FvcFollower::begin_frame(uint64_t ordinal) {
  if (state_->collecting) state_->ccd.build(state_->fvc);
  state_->collecting = collects(ordinal);
  if (state_->collecting) state_->fvc.reset();
}

void FvcFollower::see(const uint32_t* pixels, uint32_t count) {
  if (state_->collecting) state_->fvc.see_all(pixels, count);
}

FvcState FvcFollower::state() const {
  const Fvc& fvc = state_->fvc;
  FvcState out{{}, fvc.samples(), fvc.until_sample(), fvc.random_register()};
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    out.slots.push_back(fvc.valid(slot) ? FvcSlot{fvc.color(slot), fvc.count(slot), fvc.last(slot)}
                                        : FvcSlot{});
  return out;
}

const std::vector<uint32_t>& FvcFollower::ccd() const {
  return state_->ccd.colors;
}

}  // namespace tilepress
