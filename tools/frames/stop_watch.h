// Stop watch: nanoseconds since it was made.
#pragma once

#include <chrono>
#include <cstdint>

namespace tilepress {

class StopWatch {
 public:
  uint64_t nanoseconds() const {
    const auto elapsed = std::chrono::steady_clock::now() - begin_;
    return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count());
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace tilepress
