// Study assets: the built-in study and the example, embedded at build time.
#pragma once

#include <string_view>

namespace tilepress {

extern const std::string_view kPaperStudy;    ///< paper.toml
extern const std::string_view kPaperFigures;  ///< figures/paper_figures.toml
extern const std::string_view kSensitivityStudy;  ///< sensitivity.toml
extern const std::string_view kExampleStudy;  ///< example.toml

}  // namespace tilepress
