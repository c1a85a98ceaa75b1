// Statistics: the figures of a frame, per surface and per scheme, and their sums over a run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tilepress/pixel_format.h"

namespace tilepress {

/// Metrics of the frame itself, over the pixels inside the surface.
struct FrameMetrics {
  uint64_t unique_colors = 0;
  double entropy = 0;                ///< bits per pixel of the colour histogram
  double pixel_change = 0;           ///< 0..1, against the frame before; 0 in a surface's first frame
  double color_change = 0;           ///< 0..pixel_change
  double fvc_coverage = 0;           ///< 0..1, of the default FVC
  double fvc_relative_coverage = 0;  ///< 0..1
  double top100_coverage = 0;        ///< 0..1
};

/// How well an FVC knows the frame that it collected.
struct FvcFigures {
  double coverage = 0;           ///< 0..1: counts it holds / pixels that entered
  double relative_coverage = 0;  ///< 0..1: pixels of its colours / pixels of as many most frequent colours
};

/// Wires of the memory bus that change while the frame is written.
struct ToggleCounts {
  uint64_t plain = 0, inverted = 0;          ///< of the scheme; inverted: with data bus inversion
  uint64_t raw_plain = 0, raw_inverted = 0;  ///< of the frame without compression
};

constexpr size_t kOwnCounts = 4;
using OwnCounts = std::array<uint64_t, kOwnCounts>;

/// The figures of one scheme for one frame, or summed over frames. All sizes are in bits.
struct SchemeStatistics {
  uint64_t blocks = 0;
  uint64_t raw_bits = 0;
  uint64_t payload_bits = 0;
  uint64_t bursts = 0;
  uint64_t burst_bits = 128;  ///< size of one burst; the same over a run
  uint64_t csb_bits = 0;
  uint64_t palette_bits = 0;
  uint64_t extra_bits = 0;      ///< further traffic: a second pass, checksums
  OwnCounts own{};              ///< what SchemeInfo::columns names
  uint64_t checked_blocks = 0;  ///< --verify: blocks encoded, decoded and compared
  uint64_t mismatched_blocks = 0;
  bool skipped = false;  ///< the scheme does not support the surface's format; all else is 0, no row
  /// Of one frame in which the scheme's FVC collected and frame metrics were on; sums have none.
  std::optional<FvcFigures> fvc{};
  std::optional<ToggleCounts> toggles{};  ///< with ModelOptions::toggle_bits

  uint64_t moved_bits() const { return bursts * burst_bits + csb_bits + palette_bits; }
  /// raw / (payload + CSB): the paper's first comparison, no bursts.
  double rate_payload() const;
  /// raw / moved: the rate of DRAM traffic.
  double rate() const;
  /// raw / (moved + extra): the same as rate() for schemes without further traffic.
  double rate_with_extra() const;
  SchemeStatistics& operator+=(const SchemeStatistics& other);
  /// Adds the figures of a block `times` times.
  void add(const SchemeStatistics& block, uint64_t times) {
    payload_bits += block.payload_bits * times;
    bursts += block.bursts * times;
    extra_bits += block.extra_bits * times;
    for (size_t i = 0; i < own.size(); ++i) own[i] += block.own[i] * times;
    checked_blocks += block.checked_blocks * times;
    mismatched_blocks += block.mismatched_blocks * times;
  }
};

/// One frame of one surface.
struct FrameStatistics {
  uint64_t frame = 0;
  uint32_t surface = 0;
  uint32_t width = 0, height = 0;
  PixelFormat format = PixelFormat::kRgba8;
  bool warmup = false;
  uint64_t time_ns = 0;      ///< when the frame was presented, since the run began
  uint64_t readback_ns = 0;  ///< time of the capture in the program's thread
  uint64_t encode_ns = 0;    ///< time of the engine
  FrameMetrics metrics;
  std::vector<SchemeStatistics> schemes;  ///< in the order the schemes were given
};

}  // namespace tilepress
