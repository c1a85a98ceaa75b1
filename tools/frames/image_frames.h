// Image frames: a sequence of frames from image files, raw files or standard input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tilepress/surface.h"

namespace tilepress {

class Pipe;

struct FrameSize {
  uint32_t width = 0, height = 0;
  bool operator==(const FrameSize&) const = default;
};

/// Parses "720x1280"; nothing unless both sides are in 1..kMaxSurfaceSide.
std::optional<FrameSize> parse_frame_size(const std::string& text);

/// One decoded frame: R,G,B,A bytes, rows from the top, tight.
struct ImageFrame {
  std::vector<std::byte> pixels;
  uint64_t decode_ns = 0;
};

/// The frames of the files in the order given. A file with several images (an animation, a movie, pages)
/// gives as many frames. A pipe, or "-" for standard input, holds raw RGBA frames, as many as come, or a file
/// that is read once. Not thread-safe.
class ImageFrames {
 public:
  ImageFrames();
  ~ImageFrames();
  ImageFrames(ImageFrames&&) noexcept;
  /// Reads every file's header. Without `raw_size` there are no raw files. False and one
  /// line in `error` if a file is missing, unreadable, of a kind that would have to be narrowed (more than 8
  /// bits a channel), or not of the size of the first.
  bool open(const std::vector<std::string>& paths, std::optional<FrameSize> raw_size, std::string& error);

  /// The same frames, to be read by another thread. Not if streamed().
  ImageFrames another() const;

  FrameSize size() const { return size_; }
  /// kRgba8 if any image has alpha, else kRgbx8.
  PixelFormat format() const { return format_; }
  /// Nothing if streamed().
  std::optional<uint64_t> count() const;
  /// True if any frames come from a pipe, a movie or an animation: they must be read in order, each once.
  bool streamed() const { return streamed_; }

  enum class Outcome { kFrame, kEnd, kFailed };
  /// Decodes frame `index`. kEnd past the last one; kFailed with one line in `error`.
  Outcome read(uint64_t index, ImageFrame& out, std::string& error);

 private:
  struct Source;
  struct Reader;
  bool open_image(const std::string& name, const std::string& path, std::shared_ptr<Pipe> kept,
                  std::string& error);
  bool open_raw(const std::string& path, std::string& error);
  bool open_pipe(const std::string& path, bool raw_allowed, std::string& error);
  bool accept(const std::string& name, FrameSize size, std::string& error);
  Outcome read_raw(const Source& source, ImageFrame& out, std::string& error);
  Outcome read_image(const Source& source, ImageFrame& out, std::string& error);
  Outcome read_source(const Source& source, ImageFrame& out, std::string& error);
  Outcome read_next(ImageFrame& out, std::string& error);

  std::vector<Source> sources_;     ///< one per frame unless streamed
  size_t next_source_ = 0;          ///< if streamed
  std::unique_ptr<Reader> reader_;  ///< the file last opened
  FrameSize size_;
  PixelFormat format_ = PixelFormat::kRgbx8;
  bool streamed_ = false;
};

}  // namespace tilepress
