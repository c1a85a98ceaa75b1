// Compressed framebuffer: the part of a simulator's memory path that calls the codec. It takes the bytes of
// frames, and returns the DRAM accesses that write and read them compressed. It knows nothing of gem5 or
// Emerald. This header is C++11, for simulators that are built with an older standard than the codec's C++20.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace simulator {

/// What a framebuffer is, and where its compressed form lies.
struct FramebufferSettings {
  std::string scheme = "vdcp";
  uint32_t width = 0, height = 0;  ///< pixels of 4 bytes: R, G, B, A
  uint32_t tile = 32;              ///< side of a render tile, pixels
  uint32_t burst_bytes = 16;       ///< what DRAM moves at a time
  uint64_t dram_base = 0;
};

/// One surface with one scheme. The buffers of a swap chain are one surface: they share an object.
///
///   DRAM    slots, S0 bytes each | CSB plane | tables      each part begins at a multiple of max(64 bytes,
///   burst)
class CompressedFramebuffer {
 public:
  /// Called for each burst.
  using Write = std::function<void(uint64_t address, const uint8_t* bytes)>;
  using Fetch = std::function<void(uint64_t address)>;

  explicit CompressedFramebuffer(const FramebufferSettings& settings);
  ~CompressedFramebuffer();
  /// One line about a scheme that cannot serve; call nothing else then. Empty if all is well.
  const std::string& error() const;

  uint64_t bytes() const;  ///< of a raw frame
  /// The most that slots, CSB plane and tables take in DRAM.
  uint64_t dram_bytes() const;
  /// The frame that is being drawn, rows from the top. Bytes that no one writes keep their value from frame
  /// to frame.
  uint8_t* drawn();

  /// The frame is complete. Calls `write` for each burst that goes to DRAM, in the order of commitment.
  void end_frame(const Write& write);
  /// The same for a frame elsewhere in memory. `pitch_bytes` leads from a row to the row below.
  void end_frame(const uint8_t* top_row, ptrdiff_t pitch_bytes, const Write& write);

  /// Reads bytes, whole pixels, of the frame that ended last. Calls `fetch` for each burst that comes from
  /// DRAM. The object keeps one row of decoded blocks, so that a display which reads rows of pixels fetches
  /// each block once. Returns false before the first frame has ended.
  bool read(uint64_t offset, uint8_t* out, size_t size, const Fetch& fetch);

  /// Bursts of the frame that ended last if it were not compressed.
  uint64_t raw_bursts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace simulator
