// Run info: what a run is of, and how many frames it has.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tilepress {

/// Images of framebuffer objects (--targets all) have surface numbers from here on. Presented surfaces have
/// numbers from 0, so that --targets does not change their rows.
constexpr uint32_t kFirstTargetSurface = 1'000'000;
constexpr bool is_target(uint32_t surface) {
  return surface >= kFirstTargetSurface;
}

/// What run.json holds beside the totals.
struct RunInfo {
  std::vector<std::string> command;  ///< argv of the captured program or of the tool
  std::string program;               ///< base name
  int64_t pid = 0;
  std::string via;                                           ///< "preload", "glvnd", "frames", "replay"
  std::string gl_vendor, gl_renderer, gl_version, api;       ///< api: "EGL", "GLX", "OSMesa" or empty
  std::vector<std::pair<std::string, std::string>> further;  ///< more string members
};

/// Counts of presented frames, or of targets.
struct RunCounts {
  uint64_t seen = 0;          ///< presented frames, or targets that the program finished
  uint64_t captured = 0;      ///< frames with rows
  uint64_t dropped = 0;       ///< dropped because the queue was full (--on-full drop)
  uint64_t skipped = 0;       ///< left out by --frames and --every
  uint64_t unsupported = 0;   ///< in a format that tilepress does not model
  uint64_t not_captured = 0;  ///< could not be read back
};

}  // namespace tilepress
