// Study file: what a study varies and draws, in TOML.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/scheme_spec.h"

namespace tilepress {

struct StudyCategory {
  std::string name, title;
  std::vector<std::string> workloads;  ///< patterns of workload names, as fnmatch() takes them
};

/// One key that varies while the others stay as they are.
struct StudyAxis {
  std::string name, title;
  std::string scheme, key;
  std::string fixed;                        ///< "key=value,…": what else differs from the defaults
  std::vector<std::string> values;          ///< as text
  std::vector<std::string> configurations;  ///< one per value, names of StudyFile::configurations
};

struct StudyFile {
  std::string name, title;
  std::string baseline;                    ///< a name of `configurations`
  std::vector<SchemeSpec> configurations;  ///< distinct: first those that the file lists, then the axes
  std::vector<StudyCategory> categories;
  std::vector<StudyAxis> axes;
  std::vector<uint32_t> bursts;  ///< bits of DRAM bursts to model all configurations at; empty: that of the call
  std::vector<std::string> inputs;   ///< taken if the command line names none; relative to the file
  std::string figures_json;          ///< the [[figure]] tables as a JSON list
  std::vector<std::string> remarks;  ///< lines for the user: what the study leaves out
  std::string text;                  ///< the file
};

/// Parses a study. Error: kBadValue, "line N: reason". An axis without values is left out, with a remark.
Result<StudyFile> parse_study(std::string_view text);

/// Loads the built-in study "paper" or "sensitivity", or a file. Error: the name first.
Result<StudyFile> load_study(const std::string& name);

/// The built-in study of that name as text; empty if there is none.
std::string built_in_study(std::string_view name);

/// A commented study file.
std::string_view example_study();

}  // namespace tilepress
