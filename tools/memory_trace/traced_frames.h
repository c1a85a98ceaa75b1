// Traced frames: the frames of a memory trace, one after another, from a block log or a packed file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "memory_trace/block_log_reader.h"
#include "tilepress/compressed_surface.h"

namespace tilepress {

class TracedFrames {
 public:
  virtual ~TracedFrames() = default;
  /// In the order of presentation.
  virtual const std::vector<LoggedFrame>& frames() const = 0;
  /// Scheme, burst and render tile of all frames.
  virtual const CompressedSurface& model() const = 0;
  /// Whether read() fills payload, CSB and tables.
  virtual bool has_data() const = 0;
  /// Whether LoggedFrame::time_ns are the times at which a program presented its frames.
  virtual bool has_times() const = 0;
  /// `index` < frames().size(). Error texts begin with the path.
  virtual Result<void> read(size_t index, CompressedSurface& out) = 0;
};

/// Opens the block log of the run in a folder, or a file that `tilepress pack` wrote.
Result<std::unique_ptr<TracedFrames>> open_traced_frames(const std::string& path);

/// Opens a block log. `has_times`: its times are those of a program.
Result<std::unique_ptr<TracedFrames>> open_logged_frames(const std::string& path, bool has_times);

}  // namespace tilepress
