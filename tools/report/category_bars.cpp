// Category bars: rows for chart_markup.
#include "category_bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "counted.h"

namespace tilepress {

void CategoryBars::add(const std::string& category, size_t scheme, size_t workloads, double value,
                       const std::string& shown) {
  const std::string label = category_label(category);
  high_ = std::max(high_, value);
  rows_.push_back({batch_.schemes[scheme],
                   fmt::format("{} ({})", label, counted(workloads, "workload")),
                   {{value, scheme, fmt::format("{}, {}: {}", label, batch_.schemes[scheme], shown)}}});
}

std::string CategoryBars::rate_chart(const std::string& unit, const std::string& described) const {
  return row_chart(rows_, AxisScale::for_rates(0, high_), RowShape::kBars, unit, described);
}

std::string CategoryBars::percent_chart(const std::string& unit, const std::string& described) const {
  return row_chart(rows_, AxisScale::linear(100, 20), RowShape::kBars, unit, described);
}

bool same_category(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

}  // namespace tilepress
