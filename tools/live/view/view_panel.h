// View panel: draws the numbers beside the picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "live/view/capture_watch.h"
#include "live/view/view_pixels.h"
#include "live/view/window_canvas.h"

namespace tilepress {

constexpr size_t kPanelColumns = 38;  ///< characters

/// The block under the pointer.
struct PointedBlock {
  uint64_t x = 0, y = 0;              ///< in blocks
  uint64_t pixel_x = 0, pixel_y = 0;  ///< the pixel in it
};
std::optional<PointedBlock> block_under(const LivePicture& picture, const ViewRect& place, double x,
                                        double y);

/// Returns the lines above the table: program, frame, speed, coverage, queue and costs.
std::vector<std::string> capture_texts(const CaptureWatch& watch, const ViewState& state);
/// Returns the table: a head and a line per scheme, with a column for further traffic if a scheme causes any.
std::vector<std::string> rate_texts(const LiveState& state);
/// Returns the lines below the table: the scheme's blocks, and the block under the pointer.
std::vector<std::string> block_texts(const LivePicture& picture, size_t scheme,
                                     const std::optional<PointedBlock>& pointed);

/// Returns the height of the panel in lines.
size_t panel_lines(const CaptureWatch& watch);
void draw_panel(WindowCanvas& canvas, const ViewRect& place, const CaptureWatch& watch,
                const ViewState& state, const std::optional<PointedBlock>& pointed);
void draw_help(WindowCanvas& canvas, const ViewRect& window);

}  // namespace tilepress
