// Study specification: what study.json says about a study's axes, categories and figures.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// One key of a scheme that a study varies.
struct FigureAxis {
  std::string name, title, scheme, key;
  std::vector<std::string> values;          ///< as text, in the study's order
  std::vector<std::string> configurations;  ///< one per value
};

struct FigureCategory {
  std::string name, title;
};

/// A value that a paper prints.
struct PublishedPoint {
  std::string x;         ///< value of the axis, or a configuration
  std::string category;  ///< empty: of every category
  double value = 0;
};

/// One figure of the study file.
struct FigureSpec {
  std::string name{};  ///< of the files: NAME.csv, NAME.svg, NAME.pdf
  std::string kind{};  ///< a kind of figure_kinds()
  std::string title{}, caption{};
  std::string axis{};                         ///< name of a FigureAxis
  std::vector<std::string> configurations{};  ///< empty: as the kind says
  std::string value = "rate";                 ///< a column of results.csv and means.csv, without "_hmean"
  std::string normalized_to{};                ///< configuration whose value counts as 1; empty: none
  std::vector<std::string> workloads{};       ///< patterns of the workloads to draw; empty: all
  std::vector<std::string> categories{};      ///< categories to draw; empty: all
  bool by_workload = false;                   ///< a line per workload instead of one per category
  std::vector<PublishedPoint> published{};
};

struct StudySpec {
  std::string name, title, version;
  std::string baseline;  ///< configuration that frame_rates.csv holds
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<FigureCategory> categories;
  std::vector<FigureAxis> axes;
  std::vector<FigureSpec> figures;
};

/// The distinct renderers and GL versions of provenance.json, each as a name and a text. Empty without the
/// file.
std::vector<std::pair<std::string, std::string>> read_render_facts(const std::string& path);

/// Reads study.json. Fails with kFile if the file cannot be read or is no study.
Result<StudySpec> read_study_spec(const std::string& path);

}  // namespace tilepress
