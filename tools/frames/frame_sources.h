// Frame sources: the files and pipes that a sequence of frames comes from, checked before the first frame is
// read. Error texts name the file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frames/frame_size.h"
#include "tilepress/result.h"

namespace tilepress {

class FrameCacheReader;
class Pipe;

/// One image, one raw file, one frame of a frame cache, or all frames of a pipe or a sequence.
struct FrameSource {
  enum class Kind : uint8_t { kImage, kSequence, kRawFile, kRawPipe, kCached };
  Kind kind = Kind::kImage;
  std::string name;                               ///< as the user gave it
  std::string path;                               ///< where the bytes are
  uint32_t image = 0;                             ///< number of the image, or index of the frame, in its file
  std::shared_ptr<Pipe> pipe;                     ///< a raw pipe, or what keeps the file at `path` open
  std::shared_ptr<const FrameCacheReader> cache;  ///< the open file of a cached frame

  /// The frames come in order, each once; their number is not known before.
  bool is_stream() const { return kind == Kind::kSequence || kind == Kind::kRawPipe; }
};

struct FrameSources {
  std::vector<FrameSource> list;
  FrameSize size;
  PixelFormat format =
      PixelFormat::kRgbx8;  ///< kRgba8 if any image has alpha, or that of raw or cached frames
  bool streamed = false;    ///< any source is a stream

  uint64_t frame_bytes() const { return size.pixels() * (traits(format).pixel_bits / 8); }
};

/// Reads every file's header. A folder stands for its images (image_folders.h). Raw files and pipes hold frames of `raw_size` and `raw_format`: with kRgba8
/// only .rgba files are raw, else all files are. Without `raw_size` there are no raw files. Fails with
/// kBadValue if
/// --size is missing, and with another kind for a file that is missing, unreadable, not taken, or of another
/// size than the first.
Result<FrameSources> find_frame_sources(const std::vector<std::string>& paths,
                                        std::optional<FrameSize> raw_size, PixelFormat raw_format);

}  // namespace tilepress
