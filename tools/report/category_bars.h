// Category bars: a bar and a table row per category and scheme.
#pragma once

#include <string>
#include <vector>

#include "page_parts.h"

namespace tilepress {

class CategoryBars {
 public:
  explicit CategoryBars(const Batch& batch) : batch_(batch) {}
  /// `scheme`: index in the batch. `shown`: the value as text.
  void add(const std::string& category, size_t scheme, size_t workloads, double value,
           const std::string& shown);
  bool empty() const { return rows_.empty(); }
  /// The axis is linear, because the length of a bar has to show its value.
  std::string rate_chart(const std::string& unit, const std::string& described) const;
  std::string percent_chart(const std::string& unit, const std::string& described) const;

 private:
  const Batch& batch_;
  std::vector<ChartRow> rows_;
  double high_ = 0;
};

/// "ui" and "UI" are the same category.
bool same_category(std::string_view a, std::string_view b);

}  // namespace tilepress
