// Common options: CLI11 options that fill RunOptions through set_run_option.
#include "common_options.h"

#include <string>
#include <vector>

namespace tilepress {
namespace {

void set_or_throw(RunOptions& options, const std::string& name, const std::string& value) {
  std::string error;
  if (!set_run_option(options, name, value, error)) throw CLI::ValidationError("--" + error);
}

CLI::Option* add_text(CLI::App& app, RunOptions& options, const std::string& flags, const std::string& name,
                      const std::string& metavar, const std::string& text) {
  return app
      .add_option_function<std::string>(
          flags, [&options, name](const std::string& value) { set_or_throw(options, name, value); }, text)
      ->type_name(metavar);
}

}  // namespace

void add_run_options(CLI::App& app, RunOptions& options) {
  if (options.output.empty()) options.output = "tilepress-out";
  add_text(app, options, "-o,--output", "output", "DIR",
           "Folder for the results (default: " + options.output + ")");
  app.add_option_function<std::vector<std::string>>(
         "-s,--scheme",
         [&options](const std::vector<std::string>& specs) {
           std::string list;
           for (const std::string& spec : specs) list += (list.empty() ? "" : " ") + spec;
           set_or_throw(options, "scheme", list);
         },
         "Scheme as name:key=value,... ; repeat for more (default: all seven; see tilepress schemes)")
      ->type_name("SPEC")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add_text(app, options, "--tile", "tile", "N",
           "Side of a render tile in pixels, a multiple of 8 (default: 32)");
  add_text(app, options, "--burst", "burst", "BITS", "DRAM transfer unit, a power of two (default: 128)");
  add_text(app, options, "--frames", "frames", "RANGES",
           "Only these frames, as 0-99,200 (default: every frame)");
  add_text(app, options, "--every", "every", "N", "Only every N-th frame");
  app.add_flag_callback(
      "--verify", [&options] { options.model.verify = true; },
      "Encode, decode and compare every block; a mismatch is exit 1");
  add_text(app, options, "--heatmaps", "heatmaps", "every:N",
           "Keep the bits of each block of every N-th frame, as DIR/heatmaps/*.pgm");
  add_text(app, options, "--dump-frames", "dump-frames", "every:N",
           "Keep the pixels of every N-th frame, as DIR/frames/*.png");
  add_text(app, options, "--log-level", "log-level", "LEVEL",
           "trace, debug, info, warn, error or off (default: warn)");
}

void add_on_full_option(CLI::App& app, RunOptions& options) {
  add_text(app, options, "--on-full", "on-full", "block|drop",
           "When frames come faster than they are compressed: hold the program, or drop and count (default: "
           "block)");
}

}  // namespace tilepress
