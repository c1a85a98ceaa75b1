// Frame packer: moves the dumped frames of a running replay into a cache file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/cache/frame_cache.h"

namespace tilepress {

/// A run writes frames/<surface>-<frame>.rgba, and then the frame's row of frames.csv.
class FramePacker {
 public:
  explicit FramePacker(FrameCacheWriter& writer) : writer_(writer) {}
  FramePacker(const FramePacker&) = delete;
  FramePacker& operator=(const FramePacker&) = delete;
  ~FramePacker();

  /// Packs the frames that are whole by now, and removes their dumps. `run_path`: the run, which may be moved
  /// between two calls, and not during the last one. `last`: a dump that is missing is an error. Errors:
  /// those of FrameCacheWriter::add(), kFile.
  Result<void> pack(const std::string& run_path, bool last);

 private:
  Result<bool> pack_frame(const std::string& run_path, const CachedFrame& frame, bool last);
  FrameCacheWriter& writer_;
  std::string run_path_;
  int rows_ = -1;  ///< frames.csv, open: a moved run keeps its descriptor
  std::string header_, tail_;
  std::vector<CachedFrame> waiting_;  ///< have a row and are not packed
  std::vector<std::byte> pixels_;
  uint64_t packed_ = 0;
  Result<void> read_rows(const std::string& run_path);
};

}  // namespace tilepress
