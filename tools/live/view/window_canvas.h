// Window canvas: draws rectangles, pictures and text with OpenGL 1.1, in window pixels from the top left.
#pragma once

#include <cstdint>
#include <string_view>

#include "live/view/view_pixels.h"
#include "live/view/view_state.h"

namespace tilepress {

struct CanvasColor {
  uint8_t red, green, blue, alpha = 255;
};

/// A picture in graphics memory. Its pixels stay sharp when enlarged.
class CanvasTexture {
 public:
  void set(const ScreenImage& image);
  bool empty() const { return width_ == 0; }
  unsigned name() const { return name_; }

 private:
  unsigned name_ = 0;
  uint32_t width_ = 0, height_ = 0;
};

/// Requires a current context.
class WindowCanvas {
 public:
  /// `text_pixels`: height of a line of text. Returns false if the font cannot be used.
  bool start(double text_pixels);
  /// Clears the window, and sets its size for all coordinates after this.
  void begin(int width, int height, CanvasColor background);
  void clip(const ViewRect& area);
  void no_clip();
  void fill(const ViewRect& place, CanvasColor color);
  /// Fills `place` with the part of the picture from the top left to (right, bottom), both 0..1.
  void draw(const CanvasTexture& texture, const ViewRect& place, double right = 1, double bottom = 1);
  /// Draws Latin-1 in a monospaced font; (x, y) is the top left of the line. Returns the x where it ends.
  double text(double x, double y, std::string_view text, CanvasColor color);
  double character_width() const { return cell_width_; }
  double line_height() const { return cell_height_; }
  uint32_t longest_side() const { return longest_side_; }

 private:
  CanvasTexture glyphs_;
  int cell_width_ = 0, cell_height_ = 0, window_height_ = 0;
  uint32_t longest_side_ = 0;
};

/// Returns what the window shows, R,G,B rows from the top.
ScreenImage read_window(int width, int height);

}  // namespace tilepress
