// Draw figures: runs the drawing script on a study folder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

extern const std::string_view kDrawFiguresScript;     ///< draw_figures.py, embedded at build time
extern const std::string_view kFigureDrawingsScript;  ///< figure_drawings.py

/// Stores the script in figures/ of the study, where users can change its style, and runs it. The script
/// draws the figures whose rows have changed. Returns lines for the user: what could not be drawn, and why.
/// Fails if the script cannot be stored or a signal interrupts it.
Result<std::vector<std::string>> draw_figures(const std::string& study_folder);

}  // namespace tilepress
