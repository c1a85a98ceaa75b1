// Run options: what a run models and captures, and the TILEPRESS_* environment that carries it into a
// program.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/scheme_spec.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// A set of frame numbers: "0-99,200". Empty = every frame.
class FrameSet {
 public:
  /// Parses `text`. On failure returns nothing and sets `error` to one line (empty or reversed range, no
  /// number).
  static std::optional<FrameSet> parse(std::string_view text, std::string& error);
  bool contains(uint64_t frame) const;
  bool all() const { return ranges_.empty(); }
  /// Largest frame of the set; nothing when the set is every frame.
  std::optional<uint64_t> last() const;
  std::string text() const;

 private:
  struct Range {
    uint64_t first, last;
  };
  std::vector<Range> ranges_;
};

enum class OnFull : uint8_t { kBlock, kDrop };

/// How the shim reads what is presented: as a probe over a window's first frames decides, at once, through
/// pixel buffers, or in the program's own context.
enum class Readback : uint8_t { kAuto, kSync, kAsync, kInContext };

/// GL calls that end a frame of a program that does not present it. Bits of RunOptions::triggers.
enum Trigger : uint32_t { kTriggerFinish = 1, kTriggerFlush = 2, kTriggerReadPixels = 4 };

/// Options that `run`, `replay`, `frames` and the shim share.
struct RunOptions {
  std::vector<SchemeSpec> schemes = default_schemes();
  ModelOptions model;              ///< tile, burst, verify
  FrameSet frames;                 ///< frame numbers to take, per surface
  uint64_t every = 1;              ///< of those, every n-th frame number (frame % every == 0)
  uint64_t heatmaps_every = 0;     ///< a heat map of every n-th frame number; 0 = none
  uint64_t dump_frames_every = 0;  ///< the pixels of every n-th frame number; 0 = none
  OnFull on_full = OnFull::kBlock;
  uint32_t queue_frames = 3;  ///< that may wait for the worker: a crash loses as many; 1..64
  Readback readback = Readback::kAuto;
  uint32_t triggers = 0;     ///< Trigger bits
  bool all_targets = false;  ///< framebuffer objects too, not only what is presented
  std::string output;        ///< -o DIR; absolute where it goes into an environment
  std::string log_level = "warn";
  std::string log_file;  ///< where the shim writes its log; empty = nowhere

  bool takes(uint64_t frame) const { return frames.contains(frame) && frame % every == 0; }
};

/// "finish,readpixels" and the like; empty for none.
std::string trigger_list(uint32_t triggers);

/// Sets one option by its long name without dashes ("scheme", "tile", "burst", "frames", "every", "verify",
/// "heatmaps", "dump-frames", "on-full", "queue", "readback", "trigger" (a list with commas), "targets",
/// "log-level", "log-file", "output"). "scheme" takes a space-separated list and replaces the schemes.
/// Returns false and one line in `error` for an unknown name or a value out of range.
bool set_run_option(RunOptions& options, std::string_view name, std::string_view value, std::string& error);

/// The environment that makes the shim run with these options: TILEPRESS_OUT, TILEPRESS_SCHEME,
/// TILEPRESS_TILE, … All of them, an empty value standing for the default, so that none is inherited by
/// accident.
std::map<std::string, std::string> to_environment(const RunOptions& options);

/// Reads the options back from TILEPRESS_* variables; variables not set or empty leave the default.
/// False and one line in `error` at the first bad value.
bool from_environment(RunOptions& options, std::string& error);

}  // namespace tilepress
