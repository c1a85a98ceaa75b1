// Common options: what run, replay and frames share on the command line (spec §12).
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "frames/image_frames.h"
#include "tilepress/run_options.h"

namespace tilepress {

/// Values are checked while they are parsed and land in `options`, which must outlive `app`'s parsing. A bad
/// value is a CLI11 validation error: one line, exit status 2.

/// Adds -s/--scheme, --tile, --burst, --frames and --every.
void add_model_options(
    CLI::App& app, RunOptions& options,
    const std::string& scheme_text =
        "Scheme as name:key=value,... ; repeat for more (default: all seven; see tilepress schemes)");

/// The same and -o/--output, --verify, --heatmaps, --dump-frames and --log-level.
void add_run_options(CLI::App& app, RunOptions& options);

/// Adds --trigger and --targets, for verbs that capture running programs.
void add_capture_options(CLI::App& app, RunOptions& options);

/// Adds --on-full, for verbs that capture running programs.
void add_on_full_option(CLI::App& app, RunOptions& options);

/// Adds --NAME WxH.
void add_size_option(CLI::App& app, const std::string& name, std::optional<FrameSize>& size,
                     const std::string& text);

/// Adds --frames RANGES, for verbs without a run's other options.
void add_frames_option(CLI::App& app, FrameSet& frames);

}  // namespace tilepress
