// Draw figures: stores the script and looks for a Python that has matplotlib.
#include <utility>

#include "capture/child_process.h"
#include "streams/output_file.h"
#include "study/figures/study_outputs.h"

namespace tilepress {

extern const std::string_view kDrawFiguresScript, kFigureDrawingsScript,
    kFigureStylesScript;  // embedded at build time

namespace {

/// The exit status of the script when matplotlib is missing.
constexpr int kNoMatplotlib = 3;

/// Debian's package serves Debian's python3, which another python3 on PATH may hide.
constexpr const char* kPythons[] = {"python3", "/usr/bin/python3"};

/// Stores the scripts in figures/ of the study, where users can change their style, and runs the first one,
/// which draws the figures whose rows have changed. Returns lines for the user: what could not be drawn, and
/// why.
Result<std::vector<std::string>> draw_figures(const std::string& study_folder) {
  const std::pair<const char*, std::string_view> scripts[] = {{"draw_figures.py", kDrawFiguresScript},
                                                              {"figure_drawings.py", kFigureDrawingsScript},
                                                              {"figure_styles.py", kFigureStylesScript}};
  for (const auto& [name, text] : scripts)
    if (const auto written = write_whole_file(study_folder + "/figures/" + name, text, true); !written)
      return written.error();
  bool has_python = false;
  for (const char* python : kPythons) {
    const auto end = run_child({python, study_folder + "/figures/draw_figures.py", study_folder},
                               {{"PYTHONDONTWRITEBYTECODE", "1"}});
    if (!end) continue;
    has_python = true;
    if (end->told_to_end)
      return Error{ErrorKind::kSystem, study_folder + "/figures: the drawing was interrupted"};
    if (end->status() == 0) return std::vector<std::string>{};
    if (end->status() != kNoMatplotlib)
      return std::vector<std::string>{study_folder + "/figures: not every figure was drawn"};
  }
  return std::vector<std::string>{
      study_folder + "/figures: SVG and PDF were not drawn: " + (has_python ? "matplotlib" : "python3") +
      " is missing (apt-get install python3-matplotlib)"};
}

}  // namespace

Result<std::vector<std::string>> write_study_outputs(const std::string& study_folder) {
  return write_study_data(study_folder, draw_figures);
}

}  // namespace tilepress
