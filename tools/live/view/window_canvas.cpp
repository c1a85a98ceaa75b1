// Window canvas: OpenGL 1.1, which every driver with windows has, and a monospaced font in one texture.
#include "live/view/window_canvas.h"

#include <GL/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

// The library's header has unused functions and conversions.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

/// DejaVu Sans Mono, taken from Debian's package when the window is built.
extern "C" const unsigned char kEmbeddedFont[];

namespace tilepress {
namespace {

constexpr int kFirst = 32, kLast = 255, kColumns = 16, kRows = (kLast - kFirst + kColumns) / kColumns;

void set_color(CanvasColor color) {
  glColor4ub(color.red, color.green, color.blue, color.alpha);
}

void corner(double u, double v, double x, double y) {
  glTexCoord2d(u, v);
  glVertex2d(x, y);
}

void quad(const ViewRect& place, double left, double top, double right, double bottom) {
  corner(left, top, place.x, place.y);
  corner(right, top, place.x + place.width, place.y);
  corner(right, bottom, place.x + place.width, place.y + place.height);
  corner(left, bottom, place.x, place.y + place.height);
}

/// White cells whose alpha is the glyph.
bool make_glyphs(double text_pixels, int& cell_width, int& cell_height, ScreenImage& image) {
  stbtt_fontinfo font;
  if (!stbtt_InitFont(&font, kEmbeddedFont, 0)) return false;
  const float scale = stbtt_ScaleForPixelHeight(&font, static_cast<float>(text_pixels));
  int ascent = 0, descent = 0, gap = 0, advance = 0, bearing = 0;
  stbtt_GetFontVMetrics(&font, &ascent, &descent, &gap);
  stbtt_GetCodepointHMetrics(&font, 'M', &advance, &bearing);
  cell_width = static_cast<int>(std::lround(static_cast<float>(advance) * scale));
  cell_height = static_cast<int>(std::ceil(text_pixels * 1.2));
  const int baseline = static_cast<int>(std::lround(static_cast<float>(ascent) * scale + text_pixels * 0.1));
  image.width = static_cast<uint32_t>(cell_width * kColumns);
  image.height = static_cast<uint32_t>(cell_height * kRows);
  image.bytes.assign(size_t{image.width} * image.height * 4, 255);
  for (size_t i = 3; i < image.bytes.size(); i += 4) image.bytes[i] = 0;
  for (int code = kFirst; code <= kLast; ++code) {
    int width = 0, height = 0, left = 0, top = 0;
    unsigned char* glyph = stbtt_GetCodepointBitmap(&font, 0, scale, code, &width, &height, &left, &top);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int cell_x = left + x, cell_y = baseline + top + y;
        if (cell_x < 0 || cell_x >= cell_width || cell_y < 0 || cell_y >= cell_height) continue;
        const int to_x = (code - kFirst) % kColumns * cell_width + cell_x;
        const int to_y = (code - kFirst) / kColumns * cell_height + cell_y;
        image.bytes[(static_cast<size_t>(to_y) * image.width + static_cast<size_t>(to_x)) * 4 + 3] =
            glyph[y * width + x];
      }
    stbtt_FreeBitmap(glyph, nullptr);
  }
  return true;
}

}  // namespace

void CanvasTexture::set(const ScreenImage& image) {
  if (name_ == 0) glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  const auto width = static_cast<GLsizei>(image.width), height = static_cast<GLsizei>(image.height);
  if (image.width != width_ || image.height != height_) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.bytes.data());
  } else if (!image.bytes.empty()) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.bytes.data());
  }
  width_ = image.width;
  height_ = image.height;
}

bool WindowCanvas::start(double text_pixels) {
  GLint longest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &longest);
  longest_side_ = static_cast<uint32_t>(std::clamp(longest, 64, 8192));
  ScreenImage image;
  if (!make_glyphs(text_pixels, cell_width_, cell_height_, image)) return false;
  glyphs_.set(image);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_BLEND);
  return true;
}

void WindowCanvas::begin(int width, int height, CanvasColor background) {
  window_height_ = height;
  glViewport(0, 0, width, height);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(0, width, height, 0, -1, 1);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glDisable(GL_SCISSOR_TEST);
  glClearColor(background.red / 255.0f, background.green / 255.0f, background.blue / 255.0f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

void WindowCanvas::clip(const ViewRect& area) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<GLint>(area.x), window_height_ - static_cast<GLint>(area.y + area.height),
            static_cast<GLsizei>(area.width), static_cast<GLsizei>(area.height));
}

void WindowCanvas::no_clip() {
  glDisable(GL_SCISSOR_TEST);
}

void WindowCanvas::fill(const ViewRect& place, CanvasColor color) {
  glDisable(GL_TEXTURE_2D);
  set_color(color);
  glBegin(GL_QUADS);
  quad(place, 0, 0, 0, 0);
  glEnd();
}

void WindowCanvas::draw(const CanvasTexture& texture, const ViewRect& place, double right, double bottom) {
  if (texture.empty()) return;
  glEnable(GL_TEXTURE_2D);
  glBindTexture(GL_TEXTURE_2D, texture.name());
  set_color({255, 255, 255});
  glBegin(GL_QUADS);
  quad(place, 0, 0, right, bottom);
  glEnd();
}

double WindowCanvas::text(double x, double y, std::string_view text, CanvasColor color) {
  glEnable(GL_TEXTURE_2D);
  glBindTexture(GL_TEXTURE_2D, glyphs_.name());
  set_color(color);
  glBegin(GL_QUADS);
  for (const char c : text) {
    const int code = std::clamp<int>(static_cast<unsigned char>(c), kFirst, kLast) - kFirst;
    const double left = code % kColumns / double{kColumns}, top = code / kColumns / double{kRows};
    quad({x, y, double(cell_width_), double(cell_height_)}, left, top, left + 1.0 / kColumns,
         top + 1.0 / kRows);
    x += cell_width_;
  }
  glEnd();
  return x;
}

ScreenImage read_window(int width, int height) {
  ScreenImage out{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  std::vector<uint8_t> rows(size_t{out.width} * out.height * 3);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
  const size_t pitch = size_t{out.width} * 3;
  for (size_t y = out.height; y-- > 0;)
    out.bytes.insert(out.bytes.end(), rows.begin() + static_cast<ptrdiff_t>(y * pitch),
                     rows.begin() + static_cast<ptrdiff_t>((y + 1) * pitch));
  return out;
}

}  // namespace tilepress
