// Monotonic clock: nanoseconds that never run backwards.
#pragma once

#include "interposer/system_calls.h"

namespace tilepress {

inline uint64_t now_ns() {
  return clock_ns(CLOCK_MONOTONIC);
}

}  // namespace tilepress
