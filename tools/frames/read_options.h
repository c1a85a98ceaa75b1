// Read options: the command line options of verbs that read compressed surfaces.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tilepress/surface_reader.h"

namespace tilepress {

/// Adds --csb-lines and --csb-line-bursts.
void add_read_options(CLI::App& app, ReadOptions& options);

/// Parses "X,Y,WIDTH,HEIGHT". Returns nothing unless both sides are at least 1.
std::optional<PixelRect> parse_rect(const std::string& text);

}  // namespace tilepress
