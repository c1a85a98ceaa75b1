// Study outputs: writes the figures, tables, claims and the page of a finished study.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// Draws the figures of a study folder. Returns lines for the user.
using FigureDrawing = Result<std::vector<std::string>> (*)(const std::string& study_folder);

/// Writes figures/NAME.csv and figures/figures.json, tables/, claims.* and study.html from the CSV files and
/// study.json of `study_folder`. The files depend on nothing else: equal studies have equal files. Calls
/// `draw`, unless it is null, before the page is written: the page links to drawings. Returns lines for the
/// user, for example about a figure without data. Fails if a file of the study cannot be read or an output
/// cannot be written.
Result<std::vector<std::string>> write_study_data(const std::string& study_folder,
                                                  FigureDrawing draw = nullptr);

/// Does the same with figures/NAME.svg and NAME.pdf, drawn by matplotlib. Figures that have not changed are
/// not drawn again. Without python3 or matplotlib a line says so, and everything else is written.
Result<std::vector<std::string>> write_study_outputs(const std::string& study_folder);

}  // namespace tilepress
