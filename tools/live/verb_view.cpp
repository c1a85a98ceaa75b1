// tilepress view: replaces itself with tilepress-view, the program that has the window.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "capture/shim_path.h"
#include "command_line.h"
#include "frames/image_frames.h"
#include "live/ended_runs.h"
#include "live/view/view_request.h"
#include "streams/standard_streams.h"
#include "tilepress/run_reader.h"
#include "verb.h"

namespace tilepress {

constexpr const char* kWindow = "tilepress-view";

constexpr const char* kHelpTail =
    "Examples:\n"
    "  tilepress view\n"
    "  tilepress view -s hdcp --overlay only out\n"
    "  xvfb-run -a tilepress view --screenshot view.png out\n"
    "\n"
    "Keys: arrows or 1..9 scheme, h heat map, space freeze, + - zoom, f fit, Tab next capture, ? help,\n"
    "q quit. The captured program goes on when the window is closed or killed. The window is never part\n"
    "of a frame.\n";

int verb_view(int argc, char** argv) {
  ViewRequest request;
  request.folder = "tilepress-out";
  CLI::App app{
      "Shows the last frame of a running capture in a window, with the bits of each block and the schemes' "
      "rates."};
  app.footer(kHelpTail);
  app.add_option("DIR", request.folder, "A run directory, or a folder of some (default: tilepress-out)");
  app.add_option("-s,--scheme", request.scheme, "The scheme shown first, as the run names it")
      ->type_name("SPEC");
  add_choice_option<Overlay>(
      app, "--overlay", request.overlay,
      {{"blend", Overlay::kBlended}, {"only", Overlay::kHeatOnly}, {"off", Overlay::kOff}},
      "Heat map over the frame, alone, or none (default: blend)");
  app.add_option("--zoom", request.zoom, "Window pixels per frame pixel (default: 0, as large as fits)")
      ->type_name("N")
      ->check(CLI::Range(0, 32));
  app.add_option_function<std::string>(
         "--window",
         [&](const std::string& text) {
           const auto size = parse_frame_size(text);
           if (!size || size->width < 200 || size->height < 200 || size->width > 16384 ||
               size->height > 16384)
             throw CLI::ValidationError("--window " + text + ": not WxH from 200x200 to 16384x16384");
           request.width = size->width;
           request.height = size->height;
         },
         "Size of the window (default: 960x640)")
      ->type_name("WxH");
  app.add_option("--screenshot", request.screenshot,
                 "Write the window with its first frame as a PNG file, and end")
      ->type_name("FILE");
  app.add_option("--wait", request.wait_s,
                 "With --screenshot: seconds to wait for a frame; exit 3 if none comes (default: 10)")
      ->type_name("SECONDS")
      ->check(CLI::Range(1, 86400));
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  if (const auto checked = check_capture_folders({request.folder}); !checked)
    return fail(kExitFailed, checked.error());
  if (const std::string ended = ended_runs_text(request.folder); !ended.empty()) {
    if (holds_run(request.folder)) return fail(kExitNothingCaptured, request.folder + ": " + ended);
    say(MessageLevel::kWarning, request.folder + ": waiting for a capture; " + ended);
  }
  const auto window = find_shim(kWindow);
  if (!window) return fail(kExitFailed, window.error());
  // In a shell under `tilepress run`, the shim would capture the window.
  for (const char* name : {"LD_PRELOAD", "__EGL_VENDOR_LIBRARY_FILENAMES", "__GLX_VENDOR_LIBRARY_NAME"})
    if (const char* value = std::getenv(name); value != nullptr && std::strstr(value, "tilepress") != nullptr)
      unsetenv(name);
  unsetenv("TILEPRESS_OUT");
  std::vector<std::string> words = to_arguments(request);
  words.insert(words.begin(), *window);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  restore_sigpipe();
  execv(window->c_str(), arguments.data());
  return fail(kExitFailed, *window + ": " + std::strerror(errno));
}

}  // namespace tilepress
