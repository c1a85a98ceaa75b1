// Statistics: rates and sums.
#include "tilepress/statistics.h"

namespace tilepress {
namespace {
double ratio(uint64_t raw, uint64_t moved) {
  return moved == 0 ? 0.0 : static_cast<double>(raw) / static_cast<double>(moved);
}
}  // namespace

double SchemeStatistics::rate_payload() const {
  return ratio(raw_bits, payload_bits + csb_bits);
}
double SchemeStatistics::rate() const {
  return ratio(raw_bits, moved_bits());
}

double SchemeStatistics::rate_with_extra() const {
  return ratio(raw_bits, moved_bits() + extra_bits);
}

SchemeStatistics& SchemeStatistics::operator+=(const SchemeStatistics& other) {
  blocks += other.blocks;
  raw_bits += other.raw_bits;
  payload_bits += other.payload_bits;
  bursts += other.bursts;
  if (other.blocks != 0) burst_bits = other.burst_bits;  // a skipped frame has none
  csb_bits += other.csb_bits;
  palette_bits += other.palette_bits;
  extra_bits += other.extra_bits;
  for (size_t i = 0; i < own.size(); ++i) own[i] += other.own[i];
  checked_blocks += other.checked_blocks;
  mismatched_blocks += other.mismatched_blocks;
  if (other.toggles) {
    if (!toggles) toggles.emplace();
    toggles->plain += other.toggles->plain;
    toggles->inverted += other.toggles->inverted;
    toggles->raw_plain += other.toggles->raw_plain;
    toggles->raw_inverted += other.toggles->raw_inverted;
  }
  return *this;
}

}  // namespace tilepress
