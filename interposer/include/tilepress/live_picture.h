// Live picture: the last frame of a running capture and the bits of its blocks, for a watcher that asks.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/live_page.h"
#include "tilepress/surface.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

constexpr uint32_t kLivePictureVersion = 1;
/// In the run directory, from the first request until the run ends.
constexpr const char* kLivePictureFile = "live-picture";

/// The start of a slot. The pixels and the bits of the blocks follow.
struct LivePictureHead {
  LiveState state;         ///< state of the frame in the picture
  uint64_t number;         ///< number of the picture, from 1
  uint64_t width, height;  ///< pixels
  uint64_t format;         ///< PixelFormat
  uint64_t blocks_x, blocks_y;
  uint64_t raw_bits;  ///< bits of a block that is not compressed
  uint64_t burst_bits;
  uint64_t scheme_count;  ///< schemes with bits; at most state.scheme_count
};

/// The start of the file. Two slots of `slot_bytes` begin at kLiveSlotsOffset. A slot holds, in this order:
///   a sequence number, odd while the capture writes there
///   a LivePictureHead
///   `height` rows of 8 · blocks_x pixel words
///   per scheme the payload bits of its blocks in raster order, 16 bits each, padded to a multiple of four
///   blocks; kNoBlockBits in every block if the scheme does not support the surface's format
struct LivePictureFile {
  uint64_t magic;  ///< bytes "TPPICT\0\0"
  uint32_t version;
  uint32_t head_bytes;  ///< sizeof(LivePictureHead)
  uint64_t slot_bytes;
  std::atomic<uint64_t> latest;   ///< number of the last whole picture, in slot `latest % 2`; 0 = none yet
  std::atomic<uint64_t> retired;  ///< 1: a larger file has replaced this one, or the run has ended
};
constexpr size_t kLiveSlotsOffset = 4096;
constexpr uint16_t kNoBlockBits = 0xFFFF;

/// The capture's side. Makes the file with the first picture, and a new file when a frame is too large.
class LivePictureWriter {
 public:
  LivePictureWriter() = default;
  LivePictureWriter(const LivePictureWriter&) = delete;
  LivePictureWriter& operator=(const LivePictureWriter&) = delete;
  ~LivePictureWriter();
  /// Never waits for a reader. Returns 0 or an errno, as the live page passes it to watchers. The run
  /// continues without pictures.
  int write(const std::string& run_path, const LiveState& state, const SurfaceView& view,
            const BlockBits& bits, uint32_t burst_bits);
  /// Removes the file.
  void close();

 private:
  int make_file(const std::string& run_path, size_t slot_bytes);
  LivePictureFile* file_ = nullptr;
  std::string path_;
  size_t bytes_ = 0;
  uint64_t number_ = 0;  ///< of the last picture, in any file
};

/// A picture in a watcher's own memory.
struct LivePicture {
  LivePictureHead head{};
  std::vector<uint32_t> pixels;             ///< words as PixelPlane has them, height rows of 8 · blocks_x
  std::vector<std::vector<uint16_t>> bits;  ///< per scheme, blocks in raster order; empty: it has no bits
};

/// The watcher's side. It maps the file read-only.
class LivePictureReader {
 public:
  LivePictureReader() = default;
  LivePictureReader(const LivePictureReader&) = delete;
  LivePictureReader& operator=(const LivePictureReader&) = delete;
  ~LivePictureReader();
  /// Copies the latest picture of the run. False if there is no picture later than `out`, or if the capture
  /// overwrote it meanwhile; the next call tries again.
  bool read(const std::string& run_path, LivePicture& out);

 private:
  bool open(const std::string& run_path);
  bool copy_slot(uint64_t number, LivePicture& out);
  void unmap();
  LivePictureFile* file_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace tilepress
