// Common options: CLI11 options made from the table of run options.
#include "common_options.h"

#include <string_view>
#include <utility>
#include <vector>

#include "command_line.h"
#include "tilepress/run_option_table.h"

namespace tilepress {
namespace {

void set_or_throw(RunOptions& options, const RunOption& option, const std::string& value) {
  if (const auto set = set_run_option(options, option.name, value); !set)
    throw CLI::ValidationError("--" + set.error().text);
}

/// An option that may be given several times: its values make one list.
CLI::Option* add_list(CLI::App& app, RunOptions& options, const RunOption& option, const std::string& help) {
  const auto set = [&options, &option](const std::vector<std::string>& values) {
    std::string list;
    for (const std::string& value : values)
      list += (list.empty() ? "" : std::string(1, option.joint)) + value;
    if (list.empty())
      throw CLI::ValidationError("--" + std::string(option.name) + " '': must be " +
                                 std::string(option.range));
    set_or_throw(options, option, list);
  };
  return app.add_option_function<std::vector<std::string>>(std::string(option.flags), set, help)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

}  // namespace

void add_run_option(CLI::App& app, RunOptions& options, std::string_view name, const std::string& help) {
  const RunOption& option = *find_run_option(name);
  const std::string flags(option.flags), text = help.empty() ? std::string(option.help) : help;
  const auto set = [&](const std::string& value) { set_or_throw(options, option, value); };
  if (option.metavar.empty())
    app.add_flag_callback(
        flags, [=] { set("1"); }, text);
  else if (option.joint != 0)
    add_list(app, options, option, text)->type_name(std::string(option.metavar));
  else
    app.add_option_function<std::string>(flags, set, text)->type_name(std::string(option.metavar));
}

void add_frame_options(CLI::App& app, RunOptions& options) {
  for (const char* name : {"tile", "burst", "dram", "frames", "every"}) add_run_option(app, options, name);
  app.get_option("--dram")->excludes("--burst");
}

void add_model_options(CLI::App& app, RunOptions& options, const std::string& scheme_help) {
  add_run_option(app, options, "plugin");  // the values are taken in this order
  add_run_option(app, options, "scheme", scheme_help);
  add_frame_options(app, options);
}

void add_run_options(CLI::App& app, RunOptions& options) {
  if (options.output.empty()) options.output = "tilepress-out";
  add_run_option(app, options, "output",
                 std::string(find_run_option("output")->help) + " (default: " + options.output + ")");
  add_model_options(app, options);
  for (const char* name : {"toggles", "verify", "heatmaps", "dump-frames", "log-level"})
    add_run_option(app, options, name);
}

void add_capture_options(CLI::App& app, RunOptions& options) {
  for (const char* name : {"on-full", "trigger", "targets", "readback"}) add_run_option(app, options, name);
}

void add_size_option(CLI::App& app, const std::string& name, std::optional<FrameSize>& size,
                     const std::string& help) {
  app.add_option_function<std::string>(
         "--" + name,
         [&size, name](const std::string& value) {
           size = parse_frame_size(value);
           if (!size)
             throw CLI::ValidationError("--" + name + " " + value + ": must be WxH with sides in 1..65535");
         },
         help)
      ->type_name("WxH");
}

void add_raw_format_option(CLI::App& app, PixelFormat& format) {
  add_choice_option<PixelFormat>(
      app, "--format", format,
      {{"rgba", PixelFormat::kRgba8}, {"rgb565", PixelFormat::kRgb565}, {"rgb10a2", PixelFormat::kRgb10a2}},
      "Pixel format of raw frames; rgba frames are .rgba files (default: rgba)");
}

CLI::Option* add_frames_option(CLI::App& app, FrameSet& frames, const std::string& name,
                               const std::string& help) {
  const RunOption& option = *find_run_option("frames");
  return app
      .add_option_function<std::string>(
          "--" + name,
          [&frames, name](const std::string& value) {
            const auto set = FrameSet::parse(value);
            if (!set) throw CLI::ValidationError("--" + name + " " + value + ": " + set.error().text);
            frames = *set;
          },
          help.empty() ? std::string(option.help) : help)
      ->type_name(std::string(option.metavar));
}

void add_read_options(CLI::App& app, ReadOptions& options) {
  app.add_option("--csb-lines", options.csb_lines,
                 "Lines of the CSB cache, 0 = none (default: " + std::to_string(options.csb_lines) + ")")
      ->type_name("N")
      ->check(CLI::Range(0, 65536));
  app.add_option(
         "--csb-line-bursts", options.csb_line_bursts,
         "Bursts in a line of the CSB cache (default: " + std::to_string(options.csb_line_bursts) + ")")
      ->type_name("N")
      ->check(CLI::Range(1, 65536));
}

}  // namespace tilepress
