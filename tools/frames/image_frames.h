// Image frames: a sequence of frames from image files, movies, raw files, pipes or standard input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frames/frame_sources.h"
#include "frames/source_reader.h"

namespace tilepress {

/// One decoded frame, rows from the top, tight: R,G,B,A bytes, or the format of raw frames.
struct ImageFrame {
  std::vector<std::byte> pixels;
  uint64_t decode_ns = 0;
};

/// The frames of the files in the order given. A file with several images (an animation, a movie, pages) has
/// as many frames. A pipe, or "-" for standard input, holds raw frames, as many as come, or a file that is
/// read once. Error texts name the file. Not thread-safe.
class ImageFrames {
 public:
  /// See find_frame_sources().
  Result<void> open(const std::vector<std::string>& paths, std::optional<FrameSize> raw_size,
                    PixelFormat raw_format = PixelFormat::kRgba8);

  /// The same frames for another thread. Precondition: not streamed().
  ImageFrames another() const;

  FrameSize size() const { return sources_.size; }
  PixelFormat format() const { return sources_.format; }
  /// The number of frames; nothing if streamed().
  std::optional<uint64_t> count() const;
  /// True if any frames come from a pipe, a movie or an animation: read them in order, each once.
  bool streamed() const { return sources_.streamed; }

  /// Decodes frame `index`. Returns false after the last frame.
  Result<bool> read(uint64_t index, ImageFrame& out);
  /// A frame of this sequence for the engine.
  SurfaceView view(const ImageFrame& frame) const;

 private:
  Result<bool> read_next(ImageFrame& out);
  FrameSources sources_;    ///< one per frame unless streamed
  size_t next_source_ = 0;  ///< if streamed
  SourceReader reader_;
};

}  // namespace tilepress
