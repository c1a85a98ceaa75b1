// Published means: the category means that the paper prints, to stand beside a report's own.
#pragma once

#include <span>
#include <string_view>

namespace tilepress {

/// One mean of the paper (spec §11).
struct PublishedMean {
  std::string_view category;  ///< "UI", "2D" or "3D"
  std::string_view scheme;
  bool with_bursts;  ///< true: effective, `rate`; false: `rate_payload`
  double mean;
};

inline constexpr PublishedMean kPublishedMeans[] = {
    {"UI", "vdcp", true, 5.26},  {"3D", "vdcp", true, 1.75},     {"UI", "ras", true, 2.73},
    {"3D", "ras", true, 2.54},   {"UI", "red", true, 2.77},      {"UI", "hdcp", true, 7.2},
    {"2D", "hdcp", true, 5.206}, {"3D", "hdcp", true, 3.23},     {"UI", "vdcp", false, 5.56},
    {"2D", "vdcp", false, 3.02}, {"3D", "huffdcp", false, 1.80},
};

/// Energy that VDCP saves according to the paper, as a share.
struct PublishedSaving {
  std::string_view category;
  double saving;
};
inline constexpr PublishedSaving kPublishedSavings[] = {{"UI", 0.799}, {"2D", 0.644}, {"3D", 0.418}};

}  // namespace tilepress
