// Run options: what a run models and captures, and the TILEPRESS_* environment that carries the options into
// a program.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/frame_set.h"
#include "tilepress/model_options.h"
#include "tilepress/result.h"
#include "tilepress/scheme_spec.h"

namespace tilepress {

enum class OnFull : uint8_t { kBlock, kDrop };

/// How the shim reads what is presented: as a probe over a window's first frames decides, at once, through
/// pixel buffers, or in the program's own context.
enum class Readback : uint8_t { kAuto, kSync, kAsync, kInContext };

/// GL calls that end a frame of a program that does not present it. Bits of RunOptions::triggers.
enum Trigger : uint32_t { kTriggerFinish = 1, kTriggerFlush = 2, kTriggerReadPixels = 4 };

/// Options that `run`, `replay`, `frames` and the shim share. run_option_table.h has their names and texts.
struct RunOptions {
  std::vector<SchemeSpec> schemes = default_schemes();
  ModelOptions model;              ///< tile, burst, verify
  std::string dram;                ///< name of the DRAM preset that set the burst; empty = none
  FrameSet frames;                 ///< frame numbers to take, per surface
  uint64_t every = 1;              ///< of those, every n-th frame number (frame % every == 0)
  uint64_t heatmaps_every = 0;     ///< a heat map of every n-th frame number; 0 = none
  uint64_t dump_frames_every = 0;  ///< the pixels of every n-th frame number; 0 = none
  std::string block_log;           ///< full text of the scheme whose blocks the run logs (block_log.h); empty = none
  bool block_log_data = false;     ///< the log holds payload, CSB and tables too
  OnFull on_full = OnFull::kBlock;
  uint32_t queue_frames = 3;  ///< frames that may wait for the worker: a crash loses as many; 1..64
  Readback readback = Readback::kAuto;
  uint32_t triggers = 0;     ///< Trigger bits
  bool all_targets = false;  ///< also capture framebuffer objects, not only what is presented
  std::string output;        ///< -o DIR; absolute where it goes into an environment
  std::string log_level = "warn";
  std::string log_file;  ///< where the shim writes its log; empty = nowhere

  bool takes(uint64_t frame) const { return frames.contains(frame) && frame % every == 0; }
};

/// Sets the option with this long name without dashes ("tile", "on-full"). "scheme" takes a list with spaces
/// and replaces the schemes. On failure the options stay as they were, and the error starts with the name.
Result<void> set_run_option(RunOptions& options, std::string_view name, std::string_view value);

/// The environment that makes the shim run with these options: TILEPRESS_OUT, TILEPRESS_SCHEME, … It has all
/// variables, so that the program inherits none by accident. An empty value stands for the default.
std::map<std::string, std::string> to_environment(const RunOptions& options);

/// Reads the options from the TILEPRESS_* variables. A variable that is not set, or empty, changes nothing.
/// Stops at the first bad value; the options before it in the table are set.
Result<void> from_environment(RunOptions& options);

/// The options that change a run's rows, as text: "vdcp ras tile=32 burst=128 …". Two runs of the same frames
/// with equal texts have equal rows.
std::string rows_fingerprint(const RunOptions& options);

}  // namespace tilepress
