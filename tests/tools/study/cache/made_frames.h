// Made frames: pixels whose every byte a test knows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/cache/frame_cache.h"

namespace tilepress {

/// A folder for one test, removed at its end.
class TestFolder {
 public:
  TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  ~TestFolder();
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A frame and its pixels.
struct MadeFrame {
  CachedFrame header;
  std::vector<std::byte> pixels;
};

enum class Content {
  kNoise,     ///< every byte differs from frame to frame
  kGradient,  ///< rows resemble each other: LZ4 of row differences is smaller than zstd
  kMoving,    ///< a small square moves over a still picture
  kStill,     ///< all frames are equal
};

/// Frames 0 .. count-1 of one surface.
std::vector<MadeFrame> make_frames(Content content, uint32_t surface, uint32_t count, uint32_t width,
                                   uint32_t height, PixelFormat format = PixelFormat::kRgba8);

/// Writes a whole cache file of these frames in this order. Fails the test if it cannot.
void write_cache(const std::string& path, const std::vector<MadeFrame>& frames,
                 const CacheOrigin& origin = {});

std::string bytes_of_file(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

}  // namespace tilepress
