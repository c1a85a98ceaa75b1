// View state: what the window shows of a picture, and the keys that change it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "live/view/view_request.h"

namespace tilepress {

enum class ViewKey { kPrevious, kNext, kFreeze, kHeat, kFit, kLarger, kSmaller, kOther, kHelp, kQuit };

/// A rectangle in window pixels, origin at the top left.
struct ViewRect {
  double x = 0, y = 0, width = 0, height = 0;
  bool contains(double px, double py) const {
    return px >= x && py >= y && px < x + width && py < y + height;
  }
};

/// Independent of windows and GL.
struct ViewState {
  size_t scheme = 0;
  Overlay overlay = Overlay::kBlended;
  double zoom = 0;                  ///< window pixels per frame pixel; 0 = as large as fits
  double shift_x = 0, shift_y = 0;  ///< of the picture's middle from the area's, window pixels
  bool frozen = false, help = false, quit = false, other_capture = false;

  void press(ViewKey key, size_t scheme_count, double fitting_zoom);
  void choose_scheme(size_t index, size_t scheme_count);
  /// Zooms by `steps` and keeps the frame's point at (x, y) of `area` in place.
  void zoom_at(double steps, double x, double y, const ViewRect& area, double fitting_zoom);
};

/// Returns the zoom at which `width` x `height` pixels fill `area` uncut; a whole number if 1 or more.
double fitting_zoom(const ViewRect& area, uint64_t width, uint64_t height);

/// Returns the frame's place in the window: the middle of `area`, on whole pixels.
ViewRect picture_place(const ViewState& state, const ViewRect& area, uint64_t width, uint64_t height);

/// Puts picture and panel side by side in a wide window, one above the other in a narrow one. `panel_width`
/// and `panel_height` are the size of the panel's text.
struct ViewLayout {
  ViewRect picture, panel;
};
ViewLayout lay_out(double width, double height, double panel_width, double panel_height);

}  // namespace tilepress
