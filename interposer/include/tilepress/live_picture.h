// Live picture: the last frame of a running capture and the bits of its blocks, for a watcher that asks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/live_page.h"
#include "tilepress/surface.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

constexpr uint32_t kLivePictureVersion = 2;
/// In the run directory, from the first request until the run ends.
constexpr const char* kLivePictureFile = "live-picture";

/// The start of the file. The rest follows without gaps:
///   `height` rows of 8 · blocks_x pixel words
///   per scheme the payload bits of its blocks in raster order, 16 bits each; kNoBlockBits in every block if
///   the scheme does not support the surface's format
struct LivePictureHead {
  uint64_t magic;  ///< bytes "TPPICT\0\0"
  uint32_t version;
  uint32_t head_bytes;     ///< sizeof(LivePictureHead)
  LiveState state;         ///< state of the frame in the picture
  uint64_t number;         ///< number of the picture, from 1
  uint64_t width, height;  ///< pixels
  uint64_t format;         ///< PixelFormat
  uint64_t blocks_x, blocks_y;
  uint64_t raw_bits;  ///< bits of a block that is not compressed
  uint64_t burst_bits;
  uint64_t scheme_count;  ///< schemes with bits; at most state.scheme_count
};
constexpr uint16_t kNoBlockBits = 0xFFFF;

/// The capture's side. Each picture is a new file, so that a watcher never reads parts of two.
class LivePictureWriter {
 public:
  /// Never waits for a reader. Returns 0 or an errno, as the live page passes it to watchers. The run
  /// continues without pictures.
  int write(const std::string& run_path, const LiveState& state, const SurfaceView& view,
            const BlockBits& bits, uint32_t burst_bits);
  /// Removes the file.
  void close();

 private:
  std::string path_;
  uint64_t number_ = 0;  ///< of the last picture
};

/// A picture in a watcher's own memory.
struct LivePicture {
  LivePictureHead head{};
  std::vector<uint32_t> pixels;             ///< words as PixelPlane has them, height rows of 8 · blocks_x
  std::vector<std::vector<uint16_t>> bits;  ///< per scheme, blocks in raster order; empty: it has no bits
};

/// Copies the latest picture of a run. False if there is no picture later than `out`.
bool read_live_picture(const std::string& run_path, LivePicture& out);

}  // namespace tilepress
