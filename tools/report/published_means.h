// Published means: figures that the paper prints, for comparison with a report's own.
#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace tilepress {

/// One mean of the paper.
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

/// Share of DRAM energy saved.
struct PublishedSaving {
  std::string_view scheme, category;
  double saving;
};
inline constexpr PublishedSaving kPublishedSavings[] = {
    {"vdcp", "UI", 0.799}, {"vdcp", "2D", 0.644}, {"vdcp", "3D", 0.418}};

/// What the paper says about the coders of a scheme's blocks.
struct PublishedShare {
  std::string_view scheme, text;
};
inline constexpr PublishedShare kPublishedShare = {
    "hdcp", "The paper: on average, VDCP and RAS code the same number of blocks."};

/// "ui" and "UI" are the same category.
inline bool same_category(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// NaN if the paper prints no saving of the scheme in the category.
inline double published_saving(std::string_view scheme, std::string_view category) {
  for (const PublishedSaving& figure : kPublishedSavings)
    if (scheme == figure.scheme && same_category(figure.category, category)) return figure.saving;
  return NAN;
}

}  // namespace tilepress
