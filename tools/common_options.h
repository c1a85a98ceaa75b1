// Common options: what run, replay and frames share on the command line (spec §12).
#pragma once

#include <CLI/CLI.hpp>

#include "tilepress/run_options.h"

namespace tilepress {

/// Adds -o/--output, -s/--scheme, --tile, --burst, --frames, --every, --verify and --log-level. Values are
/// checked while they are parsed and land in `options`, which must outlive `app`'s parsing. A bad value is a
/// CLI11 validation error: one line, exit status 2.
void add_run_options(CLI::App& app, RunOptions& options);

/// Adds --on-full, for verbs that capture running programs.
void add_on_full_option(CLI::App& app, RunOptions& options);

}  // namespace tilepress
