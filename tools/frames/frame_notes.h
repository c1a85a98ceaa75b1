// Frame notes: what a run keeps of a frame beside its statistics: heat maps, pixels, and its blocks for a log.
#pragma once

#include <string>
#include <vector>

#include "tilepress/block_log.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/frame_pictures.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// One for each thread that processes frames.
class FrameNotes {
 public:
  /// `pictures_path`: the run folder; empty for no pictures. `log` may be closed, and must outlive this.
  FrameNotes(const RunOptions& options, const std::string& pictures_path, const BlockLog& log) : log_(log) {
    if (!pictures_path.empty()) pictures_.open(pictures_path, options);
    if (log.wants_data()) stored_.resize(options.schemes.size());
  }

  /// Processes the frame, whose number stands in `statistics`, and writes its pictures. Returns its record for
  /// the log; empty if the log is closed.
  Result<std::string> process(SurfaceEngine& engine, const SurfaceView& view, FrameStatistics& statistics) {
    BlockBits* bits = pictures_.bits_for(statistics.frame);
    if (bits == nullptr && log_.is_open()) bits = &bits_;
    engine.note_block_bits(bits);
    engine.process(view, statistics, stored_);
    if (const auto written = pictures_.write(statistics, view); !written) return written.error();
    return log_.is_open() ? log_.record(statistics, *bits, stored_) : std::string();
  }

 private:
  const BlockLog& log_;
  FramePictures pictures_;
  BlockBits bits_;                         ///< if no heat map is due
  std::vector<CompressedSurface> stored_;  ///< one per scheme if the log wants data
};

}  // namespace tilepress
