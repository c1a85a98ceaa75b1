// Block log reader: reads the blocks.log of a run (tilepress/block_log.h) and checks everything it says.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"

namespace tilepress {

/// Where a frame lies in the log, and what is known of it without its blocks.
struct LoggedFrame {
  uint64_t frame = 0;
  uint32_t surface = 0;
  uint64_t time_ns = 0;     ///< when it was presented, since the run began
  uint64_t table_bits = 0;
  uint64_t offset = 0;      ///< of the record
};

class BlockLogReader {
 public:
  /// Reads the start and the head of each record. A last record that is cut short is left out. Error texts
  /// begin with the path.
  Result<void> open(const std::string& path);
  /// In the order of presentation.
  const std::vector<LoggedFrame>& frames() const { return frames_; }
  bool has_data() const { return has_data_; }
  /// Scheme, burst and render tile of all frames.
  const CompressedSurface& model() const { return shape_; }
  /// Fills shape and block_bits of `out`, and with data the stored bytes. `index` < frames().size().
  Result<void> read(size_t index, CompressedSurface& out);

 private:
  Result<void> read_start(uint64_t file_bytes);
  Result<void> read_heads(uint64_t file_bytes);
  bool read_bytes(uint64_t offset, void* out, uint64_t size);
  Error bad(const std::string& text) const { return {ErrorKind::kFile, path_ + ": " + text}; }

  std::string path_;
  std::ifstream file_;
  CompressedSurface shape_;  ///< scheme, tile and burst of all frames
  bool has_data_ = false;
  uint64_t first_record_ = 0;
  std::vector<LoggedFrame> frames_;
};

}  // namespace tilepress
