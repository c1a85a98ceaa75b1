// Frame cache: the frames of one rendered trace in one file, without loss. FORMAT.md draws the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/result.h"
#include "tilepress/surface.h"

namespace tilepress {

/// A frame as frames.csv describes it. A change of size or format starts a new surface number.
struct CachedFrame {
  uint64_t frame = 0;    ///< number of the frame on its surface
  uint32_t surface = 0;  ///< number of the surface
  uint32_t width = 0, height = 0;
  PixelFormat format = PixelFormat::kRgba8;
  bool warmup = false;       ///< as the rendering run had it
  uint64_t time_ns = 0;      ///< when the frame was presented, since the run began
  uint64_t readback_ns = 0;  ///< time of the capture in the program's thread

  uint64_t pitch_bytes() const { return uint64_t{width} * (traits(format).pixel_bits / 8); }
  uint64_t pixel_bytes() const { return pitch_bytes() * height; }
  bool operator==(const CachedFrame&) const = default;
};

/// Where the frames come from. Texts may be empty.
struct CacheOrigin {
  std::string key;                                 ///< 64 hexadecimal digits (cache_key.h)
  std::string input;                               ///< path of the trace, for people
  std::string input_sha256;                        ///< digest of the trace
  std::string gl_vendor, gl_renderer, gl_version;  ///< as run.json has them
  std::string retracer;                            ///< "eglretrace, surfaceless EGL"
  std::string pixel_options;                       ///< options that change pixels (cache_key.h)
  std::string frame_set;                           ///< the range of frames; empty = all
  std::string version;                             ///< of tilepress
  std::string rendered;                            ///< UTC, ISO 8601
  std::string reason;               ///< why frames are missing; empty if the trace was rendered in full
  uint64_t expected_frames = 0;     ///< frames of the trace that were asked for
  uint64_t unsupported_frames = 0;  ///< in a format that tilepress does not model: not in the file
};

/// Writes a cache file. The file gets its name in finish(), whole and flushed to the disk; before, it is
/// `path` with ".partial-HOST-PID". Error texts begin with the path. Not thread-safe.
class FrameCacheWriter {
 public:
  FrameCacheWriter();
  FrameCacheWriter(const FrameCacheWriter&) = delete;
  FrameCacheWriter& operator=(const FrameCacheWriter&) = delete;
  ~FrameCacheWriter();  ///< removes the file, unless finish() succeeded

  /// Makes the file. The folder must exist. Error: kFile.
  Result<void> create(const std::string& path);
  /// Appends a frame. `pixels`: frame.pixel_bytes() bytes, top row first, tight, R,G,B,A or the native
  /// format. Frames of one surface come in order and have one size and format. Errors: kFile, kBadValue.
  Result<void> add(const CachedFrame& frame, std::span<const std::byte> pixels);
  /// Writes the index and renames the file to `path`, over an older one.
  Result<void> finish(const CacheOrigin& origin);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a cache file. Any order works; frames of a surface in rising order are fastest. Use one reader per
/// thread. Error texts begin with the path.
class FrameCacheReader {
 public:
  FrameCacheReader();
  FrameCacheReader(FrameCacheReader&&) noexcept;
  FrameCacheReader& operator=(FrameCacheReader&&) noexcept;
  ~FrameCacheReader();

  /// Opens the file and checks header, index and length. Errors: kFile if the file cannot be read, kBadBits
  /// if it is torn or damaged, kUnsupported if it is no frame cache or of another format version.
  Result<void> open(const std::string& path);
  /// A reader of the same open file for another thread. Cheap: the index is shared.
  FrameCacheReader another() const;

  const CacheOrigin& origin() const;
  uint64_t frame_count() const;
  /// Frames are in the order in which they were presented, over all surfaces. Precondition: index <
  /// frame_count().
  const CachedFrame& header(uint64_t index) const;
  /// SHA-256 over the headers (without times) and the checksums of all pixels, 64 hexadecimal digits: equal
  /// for equal frames, however and whenever they were rendered.
  const std::string& frames_digest() const;
  uint64_t raw_bytes() const;  ///< pixels of all frames

  /// Decodes a frame. The pixels belong to the reader and stay valid until the next view() or read(). Errors:
  /// kBadBits if the frame is damaged, kFile. Precondition: index < frame_count().
  Result<SurfaceView> view(uint64_t index);
  /// Decodes a frame into `pixels`, which becomes header(index).pixel_bytes() bytes.
  Result<void> read(uint64_t index, std::vector<std::byte>& pixels);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether the file begins as a frame cache of any version.
bool begins_as_frame_cache(std::span<const std::byte> start);
constexpr size_t kFrameCacheMagicBytes = 8;

}  // namespace tilepress
