// Replay choices: words of a retracer and of a display.
#include "capture/replay_choices.h"

#include "command_line.h"

namespace tilepress {

void add_replay_choices(CLI::App& app, RetracerChoice& retracer, ReplayDisplay& display,
                        std::chrono::seconds& timeout) {
  add_choice_option<RetracerChoice>(
      app, "--api", retracer,
      {{"auto", RetracerChoice::kAuto}, {"egl", RetracerChoice::kEgl}, {"glx", RetracerChoice::kGlx}},
      "Retracer: eglretrace or glretrace (default: auto)");
  add_choice_option<ReplayDisplay>(
      app, "--display", display,
      {{"auto", ReplayDisplay::kAuto},
       {"surfaceless", ReplayDisplay::kSurfaceless},
       {"xvfb", ReplayDisplay::kXvfb},
       {"x11", ReplayDisplay::kX11}},
      "Where to draw: nowhere, on a private Xvfb, or on the X server of DISPLAY (default: auto)");
  app.add_option_function<int64_t>(
         "--timeout", [&timeout](int64_t seconds) { timeout = std::chrono::seconds(seconds); },
         "Seconds without a frame after which a retracer counts as hung (default: 300; 0: never)")
      ->type_name("S")
      ->check(CLI::Range(int64_t{0}, int64_t{1} << 30));
}

}  // namespace tilepress
