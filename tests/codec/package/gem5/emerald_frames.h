// Emerald: what its renderData_t::endOfFrame() would call (codec/gem5.md). Emerald keeps the colour buffer as
// GL does: R, G, B, A bytes, the lowest row first.
#pragma once

#include <cstdint>
#include <string>

#include "compressed_framebuffer.h"

class EmeraldFrames {
 public:
  EmeraldFrames(const std::string& scheme, uint32_t width, uint32_t height)
      : pitch_(ptrdiff_t(width) * 4), height_(height), framebuffer_(settings(scheme, width, height)) {}

  /// `colors`: width × height pixels. Counts the bursts that compressed writes take.
  void endOfFrame(const uint8_t* colors) {
    const uint8_t* top_row = colors + (height_ - 1) * pitch_;
    framebuffer_.end_frame(top_row, -pitch_, [this](uint64_t, const uint8_t*) { ++bursts_; });
    raw_bursts_ += framebuffer_.raw_bursts();
  }
  uint64_t bursts() const { return bursts_; }
  uint64_t raw_bursts() const { return raw_bursts_; }

 private:
  static simulator::FramebufferSettings settings(const std::string& scheme, uint32_t width, uint32_t height) {
    simulator::FramebufferSettings out;
    out.scheme = scheme;
    out.width = width;
    out.height = height;
    return out;
  }
  const ptrdiff_t pitch_;
  const uint32_t height_;
  simulator::CompressedFramebuffer framebuffer_;
  uint64_t bursts_ = 0, raw_bursts_ = 0;
};
