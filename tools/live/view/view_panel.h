// View panel: the numbers beside the picture, as lines of text and as drawing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "live/view/capture_watch.h"
#include "live/view/view_pixels.h"
#include "live/view/window_canvas.h"

namespace tilepress {

constexpr size_t kPanelColumns = 38;  ///< characters

/// The block that the pointer is over.
struct PointedBlock {
  uint64_t x = 0, y = 0;              ///< in blocks
  uint64_t pixel_x = 0, pixel_y = 0;  ///< the pixel in it
};
std::optional<PointedBlock> block_under(const LivePicture& picture, const ViewRect& place, double x,
                                        double y);

/// What the panel says above its table: program, frame, speed, coverage, queue and costs.
std::vector<std::string> capture_texts(const CaptureWatch& watch, const ViewState& state);
/// A line of the table per scheme, the head first; with a column for further traffic where there is any.
std::vector<std::string> rate_texts(const LiveState& state);
/// What it says below: the scheme's blocks, and the one pointed at.
std::vector<std::string> block_texts(const LivePicture& picture, size_t scheme,
                                     const std::optional<PointedBlock>& pointed);

/// The height of all that in lines.
size_t panel_lines(const CaptureWatch& watch);
void draw_panel(WindowCanvas& canvas, const ViewRect& place, const CaptureWatch& watch,
                const ViewState& state, const std::optional<PointedBlock>& pointed);
void draw_help(WindowCanvas& canvas, const ViewRect& window);

}  // namespace tilepress
