// Common options: CLI11 options that fill RunOptions through set_run_option.
#include "common_options.h"

#include <string>
#include <vector>

namespace tilepress {
namespace {

constexpr const char* kFramesText = "Only these frames, as 0-99,200 (default: every frame)";

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

void add_model_options(CLI::App& app, RunOptions& options, const std::string& scheme_text) {
  app.add_option_function<std::vector<std::string>>(
         "-s,--scheme",
         [&options](const std::vector<std::string>& specs) {
           std::string list;
           for (const std::string& spec : specs) list += (list.empty() ? "" : " ") + spec;
           set_or_throw(options, "scheme", list);
         },
         scheme_text)
      ->type_name("SPEC")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add_text(app, options, "--tile", "tile", "N",
           "Side of a render tile in pixels, a multiple of 8 (default: 32)");
  add_text(app, options, "--burst", "burst", "BITS", "DRAM transfer unit, a power of two (default: 128)");
  add_text(app, options, "--frames", "frames", "RANGES", kFramesText);
  add_text(app, options, "--every", "every", "N", "Only every N-th frame");
}

void add_run_options(CLI::App& app, RunOptions& options) {
  if (options.output.empty()) options.output = "tilepress-out";
  add_text(app, options, "-o,--output", "output", "DIR",
           "Folder for the results (default: " + options.output + ")");
  add_model_options(app, options);
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

void add_capture_options(CLI::App& app, RunOptions& options) {
  app.add_option_function<std::vector<std::string>>(
         "--trigger",
         [&options](const std::vector<std::string>& calls) {
           std::string list;
           for (const std::string& call : calls) list.append(list.empty() ? "" : ",").append(call);
           set_or_throw(options, "trigger", list.empty() ? "none" : list);
         },
         "GL calls that end a frame beside the presenting ones, for programs that present nothing: of the "
         "bound "
         "framebuffer; a list with commas")
      ->type_name("finish|flush|readpixels")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add_text(app, options, "--targets", "targets", "presented|all",
           "What is presented, or also each image of the program's own framebuffers, a surface of its own "
           "(default: "
           "presented)");
  add_text(app, options, "--readback", "readback", "auto|sync|async|in-context",
           "Read frames at once, through pixel buffers, or in the program's own context (default: auto, as the "
           "first frames of a window show)");
}

void add_on_full_option(CLI::App& app, RunOptions& options) {
  add_text(app, options, "--on-full", "on-full", "block|drop",
           "When frames come faster than they are compressed: hold the program, or drop and count (default: "
           "block)");
}

void add_size_option(CLI::App& app, const std::string& name, std::optional<FrameSize>& size,
                     const std::string& text) {
  app.add_option_function<std::string>(
         "--" + name,
         [&size, name](const std::string& value) {
           size = parse_frame_size(value);
           if (!size)
             throw CLI::ValidationError("--" + name + " " + value + ": not WxH with sides in 1..65535");
         },
         text)
      ->type_name("WxH");
}

void add_frames_option(CLI::App& app, FrameSet& frames) {
  app.add_option_function<std::string>(
         "--frames",
         [&frames](const std::string& value) {
           std::string error;
           const auto set = FrameSet::parse(value, error);
           if (!set) throw CLI::ValidationError("--frames " + value + ": " + error);
           frames = *set;
         },
         kFramesText)
      ->type_name("RANGES");
}

}  // namespace tilepress
