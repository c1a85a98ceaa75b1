// Window canvas: rectangles, pictures and text in window pixels, origin at the top left, through OpenGL 1.1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "live/view/view_pixels.h"
#include "live/view/view_state.h"

namespace tilepress {

struct CanvasColor {
  uint8_t red, green, blue, alpha = 255;
};

/// A picture on the graphics side. Pixels stay sharp when it is enlarged.
class CanvasTexture {
 public:
  void set(const ScreenImage& image);
  bool empty() const { return width_ == 0; }
  unsigned name() const { return name_; }

 private:
  unsigned name_ = 0;
  uint32_t width_ = 0, height_ = 0;
};

/// Needs a current context for as long as it is used.
class WindowCanvas {
 public:
  /// `text_pixels`: height of a line of text. False if the font cannot be used.
  bool start(double text_pixels);
  /// Clears; from here on coordinates are those of a window of this size.
  void begin(int width, int height, CanvasColor background);
  void clip(const ViewRect& area);
  void no_clip();
  void fill(const ViewRect& place, CanvasColor color);
  /// `place` is filled with the part of the picture from the top left to (right, bottom), both 0..1.
  void draw(const CanvasTexture& texture, const ViewRect& place, double right = 1, double bottom = 1);
  /// Latin-1 in a font of fixed width; (x, y) is the top left of the line. Returns where the text ends.
  double text(double x, double y, std::string_view text, CanvasColor color);
  double character_width() const { return cell_width_; }
  double line_height() const { return cell_height_; }
  uint32_t longest_side() const { return longest_side_; }

 private:
  CanvasTexture glyphs_;
  int cell_width_ = 0, cell_height_ = 0, window_height_ = 0;
  uint32_t longest_side_ = 0;
};

/// What the window shows now, R,G,B rows from the top.
ScreenImage read_window(int width, int height);

}  // namespace tilepress
