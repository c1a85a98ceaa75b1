// Source reader: decodes the frames of a source.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "frames/frame_sources.h"
#include "images/image_library.h"
#include "study/cache/frame_cache.h"

namespace tilepress {

/// Keeps the last file open: the frames of a sequence come in order. Not thread-safe.
class SourceReader {
 public:
  /// Decodes the source's frame, or its next frame for a stream, to R,G,B,A or to the format of raw frames.
  /// Returns false after the last frame of a stream. `out`: a whole frame of `size`.
  Result<bool> read(const FrameSource& source, FrameSize size, std::span<std::byte> out);
  /// The next read() opens its file again.
  void close() { file_.reset(); }

 private:
  Result<bool> read_cached(const FrameSource& source, std::span<std::byte> out);
  Result<bool> read_image(const FrameSource& source, FrameSize size, std::span<std::byte> out);
  std::string path_;
  std::unique_ptr<ImageFile> file_;  ///< the file at path_, or null
  FrameCacheReader cache_;           ///< for frames of cache_of_
  std::shared_ptr<const FrameCacheReader> cache_of_;
};

}  // namespace tilepress
