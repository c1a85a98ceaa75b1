// Block log: the payload bits of every block of a run, of one scheme. A memory trace is made of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tilepress/append_file.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/result.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// The name of the log in a run folder.
constexpr std::string_view kBlockLogName = "blocks.log";

// The log, little-endian, without gaps:
//
//   |BlockLogStart|scheme, as text| record, record, …
//   record  |BlockLogRecord|payload bits 16| × blocks, in raster order
//           with data: |payload bytes of each block, ceil(bits / 8)| …|CSB plane|tables|
//
// A killed program may leave a record that is cut short. It is the last one.

constexpr char kBlockLogMagic[8] = {'T', 'P', 'B', 'L', 'O', 'C', 'K', 'S'};
constexpr uint32_t kBlockLogVersion = 1;

struct BlockLogStart {
  char magic[8];
  uint32_t version;
  uint32_t tile_side;   ///< pixels
  uint32_t burst_bits;
  uint32_t has_data;    ///< 1: records hold payload, CSB and tables
  uint32_t scheme_bytes;
  uint32_t zero;
};
static_assert(sizeof(BlockLogStart) == 32);

struct BlockLogRecord {
  uint64_t bytes;       ///< of the record after this struct
  uint64_t frame;
  uint64_t time_ns;     ///< when the frame was presented, since the run began
  uint64_t table_bits;
  uint32_t surface;
  uint32_t width, height;  ///< pixels
  uint32_t format;         ///< PixelFormat
  uint32_t csb_bits;       ///< of one block
  uint32_t zero;
};
static_assert(sizeof(BlockLogRecord) == 56);

/// Writes the log of a run: each frame is one write(), so that a kill loses no finished frame. Not
/// thread-safe. record() may run in any thread.
class BlockLog {
 public:
  /// Begins the log in the folder `run_path`, if `options.block_log` names a scheme of the run. Error: kFile,
  /// or kBadValue if the run does not have that scheme.
  Result<void> create(const std::string& run_path, const RunOptions& options);
  bool is_open() const { return file_.is_open(); }
  /// Whether append() needs the stored surfaces of a frame.
  bool wants_data() const { return has_data_; }

  /// Returns the record of a frame, whose engine noted `bits`. `surfaces`: as SurfaceEngine::process() filled
  /// them; only used with data. Empty if the scheme does not support the surface's format.
  std::string record(const FrameStatistics& frame, const BlockBits& bits,
                     std::span<const CompressedSurface> surfaces) const;
  /// Appends what record() returned.
  Result<void> append(const std::string& record);

 private:
  AppendFile file_;
  size_t scheme_ = 0;  ///< its place in the run's list
  bool has_data_ = false;
};

}  // namespace tilepress
