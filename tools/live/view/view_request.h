// View request: what `tilepress view` passes to tilepress-view. That is a program of its own, so that no
// other verb loads GL.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tilepress {

enum class Overlay { kBlended, kHeatOnly, kOff };

struct ViewRequest {
  std::string folder;      ///< a run directory, or a folder of some
  std::string scheme;      ///< shown first; empty = the first one
  std::string screenshot;  ///< PNG to write; empty = a window to look at
  uint32_t width = 960, height = 640;
  uint32_t zoom = 0;  ///< pixels of the window per pixel of the frame; 0 = as large as fits
  Overlay overlay = Overlay::kBlended;
  uint32_t wait_s = 10;  ///< for a frame to take a screenshot of
};

/// To the argv of tilepress-view from [1] on, and back. Returns nothing for other arguments.
std::vector<std::string> to_arguments(const ViewRequest& request);
std::optional<ViewRequest> from_arguments(const std::vector<std::string>& arguments);

}  // namespace tilepress
