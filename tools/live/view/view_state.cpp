// View state: keys, zoom and places, as plain arithmetic.
#include "live/view/view_state.h"

#include <algorithm>
#include <cmath>

namespace tilepress {

constexpr double kSteps[] = {0.0625, 0.125, 0.25, 0.5, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32};

static double step_from(double zoom, double steps) {
  for (; steps >= 1; --steps) {
    const auto* next = std::upper_bound(std::begin(kSteps), std::end(kSteps), zoom + 1e-9);
    if (next != std::end(kSteps)) zoom = *next;
  }
  for (; steps <= -1; ++steps) {
    const auto* next = std::lower_bound(std::begin(kSteps), std::end(kSteps), zoom - 1e-9);
    if (next != std::begin(kSteps)) zoom = *(next - 1);
  }
  return zoom;
}

void ViewState::choose_scheme(size_t index, size_t scheme_count) {
  if (index < scheme_count) scheme = index;
}

void ViewState::press(ViewKey key, size_t scheme_count, double fitting) {
  const double now = zoom > 0 ? zoom : fitting;
  switch (key) {
    case ViewKey::kPrevious:
      if (scheme_count > 0) scheme = (scheme + scheme_count - 1) % scheme_count;
      break;
    case ViewKey::kNext:
      if (scheme_count > 0) scheme = (scheme + 1) % scheme_count;
      break;
    case ViewKey::kFreeze:
      frozen = !frozen;
      break;
    case ViewKey::kHeat:
      overlay = static_cast<Overlay>((static_cast<int>(overlay) + 1) % 3);
      break;
    case ViewKey::kFit:
      zoom = shift_x = shift_y = 0;
      break;
    case ViewKey::kLarger:
      zoom = step_from(now, 1);
      break;
    case ViewKey::kSmaller:
      zoom = step_from(now, -1);
      break;
    case ViewKey::kOther:
      other_capture = true;
      break;
    case ViewKey::kHelp:
      help = !help;
      break;
    case ViewKey::kQuit:
      if (help)
        help = false;
      else
        quit = true;
      break;
  }
}

void ViewState::zoom_at(double steps, double x, double y, const ViewRect& area, double fitting) {
  const double before = zoom > 0 ? zoom : fitting;
  zoom = step_from(before, steps);
  const double middle_x = area.x + area.width / 2, middle_y = area.y + area.height / 2;
  shift_x = (x - middle_x) - (x - middle_x - shift_x) * zoom / before;
  shift_y = (y - middle_y) - (y - middle_y - shift_y) * zoom / before;
}

double fitting_zoom(const ViewRect& area, uint64_t width, uint64_t height) {
  if (width == 0 || height == 0) return 1;
  const double zoom =
      std::min(area.width / static_cast<double>(width), area.height / static_cast<double>(height));
  return zoom >= 1 ? std::floor(zoom) : std::max(zoom, 1.0 / 64);
}

ViewRect picture_place(const ViewState& state, const ViewRect& area, uint64_t width, uint64_t height) {
  const double zoom = state.zoom > 0 ? state.zoom : fitting_zoom(area, width, height);
  ViewRect out;
  out.width = std::max(1.0, std::round(static_cast<double>(width) * zoom));
  out.height = std::max(1.0, std::round(static_cast<double>(height) * zoom));
  out.x = std::round(area.x + (area.width - out.width) / 2 + state.shift_x);
  out.y = std::round(area.y + (area.height - out.height) / 2 + state.shift_y);
  return out;
}

ViewLayout lay_out(double width, double height, double panel_width, double panel_height) {
  ViewLayout out;
  if (width >= 1.8 * panel_width) {
    out.picture = {0, 0, width - panel_width, height};
    out.panel = {width - panel_width, 0, panel_width, height};
  } else {
    const double picture_height = std::max(height - panel_height, height * 0.35);
    out.picture = {0, 0, width, std::floor(picture_height)};
    out.panel = {0, out.picture.height, width, height - out.picture.height};
  }
  return out;
}

}  // namespace tilepress
