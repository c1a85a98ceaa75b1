// Common options: options that several verbs share on the command line.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "frames/image_frames.h"
#include "tilepress/run_options.h"
#include "tilepress/surface_reader.h"

namespace tilepress {

// The options write into `options`, `size` or `frames`, which must outlive the parsing by `app`. A bad value
// is a CLI11 validation error: one line, exit status 2. An empty `help` stands for the text of the table.

/// Adds one option of the table of run options. Precondition: the table has the option, with flags.
void add_run_option(CLI::App& app, RunOptions& options, std::string_view name, const std::string& help = "");

/// Adds --tile, --burst or --dram, --frames and --every.
void add_frame_options(CLI::App& app, RunOptions& options);

/// Adds --plugin, -s/--scheme and the options of add_frame_options().
void add_model_options(CLI::App& app, RunOptions& options, const std::string& scheme_help = "");

/// Adds -o/--output, the model options, --verify, --heatmaps, --dump-frames and --log-level.
void add_run_options(CLI::App& app, RunOptions& options);

/// Adds --on-full, --trigger, --targets and --readback, for verbs that capture running programs.
void add_capture_options(CLI::App& app, RunOptions& options);

/// Adds --NAME WxH.
void add_size_option(CLI::App& app, const std::string& name, std::optional<FrameSize>& size,
                     const std::string& help);

/// Adds --format rgba|rgb565|rgb10a2, the pixel format of raw frames.
void add_raw_format_option(CLI::App& app, PixelFormat& format);

/// Adds --NAME RANGES, for verbs without a run's other options.
CLI::Option* add_frames_option(CLI::App& app, FrameSet& frames, const std::string& name = "frames",
                               const std::string& help = "");

/// Adds --csb-lines and --csb-line-bursts, for verbs that read compressed surfaces.
void add_read_options(CLI::App& app, ReadOptions& options);

}  // namespace tilepress
