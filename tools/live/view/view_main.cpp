// tilepress-view: the window of `tilepress view`. It maps the files that the capture shares and draws in its
// own process.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "live/view/view_panel.h"
#include "live/view/view_request.h"
#include "streams/messages.h"
#include "streams/output_file.h"
#include "streams/standard_streams.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace tilepress {
namespace {

constexpr double kTextPixels = 15;
constexpr double kPollSeconds = 0.05;
constexpr CanvasColor kBackground{16, 17, 20};

std::string glfw_error;

/// Keys without a character.
constexpr std::pair<int, ViewKey> kKeys[] = {
    {GLFW_KEY_LEFT, ViewKey::kPrevious}, {GLFW_KEY_UP, ViewKey::kPrevious}, {GLFW_KEY_RIGHT, ViewKey::kNext},
    {GLFW_KEY_DOWN, ViewKey::kNext},     {GLFW_KEY_TAB, ViewKey::kOther},   {GLFW_KEY_F1, ViewKey::kHelp},
    {GLFW_KEY_ESCAPE, ViewKey::kQuit}};

/// Characters as typed, in any keyboard layout.
constexpr std::pair<char32_t, ViewKey> kCharacters[] = {
    {U'q', ViewKey::kQuit},   {U'Q', ViewKey::kQuit},    {U'h', ViewKey::kHeat},   {U'H', ViewKey::kHeat},
    {U'f', ViewKey::kFit},    {U'F', ViewKey::kFit},     {U' ', ViewKey::kFreeze}, {U'+', ViewKey::kLarger},
    {U'=', ViewKey::kLarger}, {U'-', ViewKey::kSmaller}, {U'?', ViewKey::kHelp}};

int fail_view(int status, const std::string& line) {
  return fail(status, "view: " + line);
}

class ViewWindow {
 public:
  explicit ViewWindow(const ViewRequest& request) : request_(request), watch_(request.folder) {
    state_.overlay = request.overlay;
    state_.zoom = request.zoom;
  }
  Result<void> open();
  int run();
  ~ViewWindow() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
  }

 private:
  static ViewWindow& of(GLFWwindow* window) {
    return *static_cast<ViewWindow*>(glfwGetWindowUserPointer(window));
  }
  size_t scheme_count() const { return watch_.capture().now.scheme_count; }
  double fitting() const {
    return fitting_zoom(layout_.picture, watch_.picture().head.width, watch_.picture().head.height);
  }
  void press(int key);
  void type(char32_t character);
  void scroll(double steps);
  void drag(double x, double y);
  void choose_asked_scheme();
  void lay_out_window();
  void update_textures();
  void draw();
  void set_title();
  int write_screenshot();
  double pointer_scale() const;

  const ViewRequest request_;
  GLFWwindow* window_ = nullptr;
  CaptureWatch watch_;
  ViewState state_;
  WindowCanvas canvas_;
  CanvasTexture frame_, heat_;
  ViewLayout layout_;
  int width_ = 0, height_ = 0;
  double pointer_x_ = -1, pointer_y_ = -1;
  bool dirty_ = true, dragging_ = false, scheme_chosen_ = false;
  uint64_t shown_picture_ = 0;
  size_t shown_scheme_ = 0;
  Overlay shown_overlay_ = Overlay::kOff;
  std::string shown_path_, title_;
};

Result<void> ViewWindow::open() {
  glfwWindowHint(GLFW_DOUBLEBUFFER, GLFW_TRUE);
  glfwWindowHint(GLFW_FOCUS_ON_SHOW, request_.screenshot.empty() ? GLFW_TRUE : GLFW_FALSE);
  window_ = glfwCreateWindow(static_cast<int>(request_.width), static_cast<int>(request_.height),
                             "tilepress view", nullptr, nullptr);
  if (window_ == nullptr) return Error{ErrorKind::kSystem, "no window with OpenGL: " + glfw_error};
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  float scale_x = 1, scale_y = 1;
  glfwGetWindowContentScale(window_, &scale_x, &scale_y);
  if (!canvas_.start(std::round(kTextPixels * std::clamp(scale_y, 1.0f, 4.0f))))
    return Error{ErrorKind::kSystem, "the font cannot be read"};
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_RELEASE) of(window).press(key);
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) { of(window).type(character); });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) { of(window).scroll(steps); });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) { of(window).drag(x, y); });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    if (button == GLFW_MOUSE_BUTTON_LEFT) of(window).dragging_ = action == GLFW_PRESS;
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { of(window).dirty_ = true; });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { of(window).dirty_ = true; });
  return {};
}

void ViewWindow::press(int key) {
  for (const auto& [pressed, meaning] : kKeys)
    if (pressed == key) state_.press(meaning, scheme_count(), fitting());
  dirty_ = true;
}

void ViewWindow::type(char32_t character) {
  for (const auto& [typed, meaning] : kCharacters)
    if (typed == character) state_.press(meaning, scheme_count(), fitting());
  if (character >= U'1' && character <= U'9') state_.choose_scheme(character - U'1', scheme_count());
  dirty_ = true;
}

void ViewWindow::scroll(double steps) {
  if (!watch_.has_picture() || !layout_.picture.contains(pointer_x_, pointer_y_) || steps == 0) return;
  state_.zoom_at(steps > 0 ? std::max(1.0, steps) : std::min(-1.0, steps), pointer_x_, pointer_y_,
                 layout_.picture, fitting());
  dirty_ = true;
}

double ViewWindow::pointer_scale() const {
  int window_width = 0, window_height = 0;
  glfwGetWindowSize(window_, &window_width, &window_height);
  return window_width > 0 ? static_cast<double>(width_) / window_width : 1;
}

void ViewWindow::drag(double x, double y) {
  x *= pointer_scale();
  y *= pointer_scale();
  if (dragging_) {
    if (state_.zoom <= 0) state_.zoom = fitting();
    state_.shift_x += x - pointer_x_;
    state_.shift_y += y - pointer_y_;
  }
  pointer_x_ = x;
  pointer_y_ = y;
  dirty_ = true;
}

void ViewWindow::choose_asked_scheme() {
  if (scheme_chosen_ || !watch_.attached()) return;
  scheme_chosen_ = true;
  const LiveState& now = watch_.capture().now;
  for (size_t i = 0; i < now.scheme_count; ++i)
    if (printable_name(now.schemes[i].name) == request_.scheme) state_.scheme = i;
}

void ViewWindow::lay_out_window() {
  glfwGetFramebufferSize(window_, &width_, &height_);
  const double panel_width = (kPanelColumns + 2) * canvas_.character_width();
  const double panel_height = (static_cast<double>(panel_lines(watch_)) + 1) * canvas_.line_height();
  layout_ = lay_out(width_, height_, panel_width, panel_height);
}

void ViewWindow::update_textures() {
  const LivePicture& picture = watch_.picture();
  const bool other = picture.head.number != shown_picture_ || watch_.capture().path != shown_path_;
  if (other) frame_.set(frame_image(picture, canvas_.longest_side()));
  if (other || state_.scheme != shown_scheme_ || state_.overlay != shown_overlay_)
    heat_.set(heat_image(picture, state_.scheme, state_.overlay == Overlay::kHeatOnly));
  shown_picture_ = picture.head.number;
  shown_path_ = watch_.capture().path;
  shown_scheme_ = state_.scheme;
  shown_overlay_ = state_.overlay;
}

void ViewWindow::draw() {
  lay_out_window();
  if (width_ == 0 || height_ == 0) return;  // iconified
  canvas_.begin(width_, height_, kBackground);
  std::optional<PointedBlock> pointed;
  if (watch_.has_picture()) {
    update_textures();
    const LivePictureHead& head = watch_.picture().head;
    const ViewRect place = picture_place(state_, layout_.picture, head.width, head.height);
    canvas_.clip(layout_.picture);
    if (state_.overlay != Overlay::kHeatOnly) canvas_.draw(frame_, place);
    // The last blocks may extend beyond the frame.
    if (state_.overlay != Overlay::kOff)
      canvas_.draw(heat_, place, static_cast<double>(head.width) / static_cast<double>(head.blocks_x * 8),
                   static_cast<double>(head.height) / static_cast<double>(head.blocks_y * 8));
    if (layout_.picture.contains(pointer_x_, pointer_y_))
      pointed = block_under(watch_.picture(), place, pointer_x_, pointer_y_);
    canvas_.no_clip();
  }
  draw_panel(canvas_, layout_.panel, watch_, state_, pointed);
  if (state_.help) draw_help(canvas_, {0, 0, double(width_), double(height_)});
}

void ViewWindow::set_title() {
  std::string title = "tilepress view";
  if (watch_.attached()) {
    const LiveState& now = watch_.capture().now;
    title.append(": ")
        .append(printable_name(now.program))
        .append(" (")
        .append(std::to_string(now.pid))
        .append(")");
    if (state_.scheme < now.scheme_count)
      title.append(" ").append(printable_name(now.schemes[state_.scheme].name));
    if (watch_.capture().ended)
      title += " ended";
    else if (state_.frozen)
      title += " frozen";
    else if (!watch_.has_picture())
      title += " waiting";
  }
  if (title != title_) glfwSetWindowTitle(window_, title.c_str());
  title_ = title;
}

int ViewWindow::write_screenshot() {
  const ScreenImage image = read_window(width_, height_);
  OutputFile file;
  const auto append = [](void* to, void* bytes, int size) {
    static_cast<OutputFile*>(to)->write({static_cast<const char*>(bytes), static_cast<size_t>(size)});
  };
  if (const auto opened = file.open(request_.screenshot, true); !opened) return fail_view(1, opened.error().text);
  if (stbi_write_png_to_func(append, &file, width_, height_, 3, image.bytes.data(), width_ * 3) == 0)
    return fail_view(1, request_.screenshot + ": cannot be encoded");
  if (const auto done = file.commit(); !done) return fail_view(1, done.error().text);
  const LiveState& state = watch_.picture().head.state;
  show(fmt::format("{}: frame {} of surface {}\n", request_.screenshot, state.frame, state.surface));
  return 0;
}

int ViewWindow::run() {
  const bool screenshot = !request_.screenshot.empty();
  const auto begin = std::chrono::steady_clock::now();
  while (!state_.quit && !glfwWindowShouldClose(window_)) {
    if (watch_.refresh(!state_.frozen)) dirty_ = true;
    choose_asked_scheme();
    if (state_.other_capture) {
      state_.other_capture = false;
      state_.frozen = false;
      watch_.attach_next();
      state_.choose_scheme(0, state_.scheme >= scheme_count() ? 1 : 0);
      dirty_ = true;
    }
    if (dirty_) {
      dirty_ = false;
      draw();
      set_title();
      if (screenshot && watch_.has_picture()) return write_screenshot();
      glfwSwapBuffers(window_);
    }
    if (screenshot && std::chrono::steady_clock::now() - begin > std::chrono::seconds(request_.wait_s)) {
      if (!watch_.attached())
        return fail_view(3,
                         watch_.error().empty() ? request_.folder + ": no running capture" : watch_.error());
      return fail_view(
          3, watch_.capture().path + ": no frame came within " + std::to_string(request_.wait_s) + " s");
    }
    glfwWaitEventsTimeout(kPollSeconds);
  }
  return 0;
}

int view(int argc, char** argv) {
  const auto request = from_arguments({argv + 1, argv + argc});
  if (!request) return fail_view(2, "this is a part of tilepress: use tilepress view");
  glfwSetErrorCallback([](int, const char* text) { glfw_error = text; });
  if (glfwInit() != GLFW_TRUE) {
    const char* display = std::getenv("DISPLAY");
    return fail_view(
        1, display == nullptr || *display == 0
               ? "no display: DISPLAY is not set (tilepress top needs none; xvfb-run -a gives one for "
                 "--screenshot)"
               : std::string("no display: cannot open ") + display);
  }
  int status = 0;
  {
    ViewWindow window(*request);
    const auto opened = window.open();
    status = opened ? window.run() : fail_view(1, opened.error().text);
  }
  glfwTerminate();
  return status;
}

}  // namespace
}  // namespace tilepress

int main(int argc, char** argv) {
  tilepress::guard_standard_streams();
  return tilepress::view(argc, argv);
}
