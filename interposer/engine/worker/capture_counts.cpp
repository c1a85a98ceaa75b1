// Capture counts: raised in memory, and in the shared page while there is one.
#include "interposer/engine/worker/capture_counts.h"

namespace tilepress {

void RoleCounts::raise(Count count, uint64_t by) {
  const uint64_t now = (counts_.*count += by);
  LiveCounts* shared = shared_;
  if (shared == nullptr) return;
  std::atomic<uint64_t>& shown = shared->*count;
  for (uint64_t before = shown; before < now && !shown.compare_exchange_weak(before, now);) {
  }
}

void RoleCounts::show_in(LiveCounts* shared) {
  shared_ = shared;
  if (shared == nullptr) return;
  for (const Count count : {&LiveCounts::seen, &LiveCounts::captured, &LiveCounts::dropped,
                            &LiveCounts::skipped, &LiveCounts::unsupported, &LiveCounts::not_captured})
    raise(count, 0);
}

void RoleCounts::settle() {
  const RunCounts known = now();
  const uint64_t traced =
      known.captured + known.dropped + known.skipped + known.unsupported + known.not_captured;
  if (known.seen > traced) raise(&LiveCounts::not_captured, known.seen - traced);
}

}  // namespace tilepress
