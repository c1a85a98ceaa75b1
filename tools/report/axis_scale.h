// Axis scale: from values to positions along an axis, and the ticks to write on it.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace tilepress {

/// The smallest and the largest of some values.
struct ValueRange {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// A linear axis from 0, or a logarithmic one between powers of two.
class AxisScale {
 public:
  /// An axis for values up to `high`; logarithmic if `high` passes 16 and `low` > 0.
  static AxisScale for_rates(double low, double high);
  /// A linear axis from 0 to `top`, ticks every `step`.
  static AxisScale linear(double top, double step);

  /// Position of `value` along the axis, 0..100 percent, clamped.
  double percent(double value) const;
  const std::vector<double>& ticks() const { return ticks_; }
  bool logarithmic() const { return logarithmic_; }
  static std::string tick_text(double tick);

 private:
  double low_ = 0, high_ = 1;
  bool logarithmic_ = false;
  std::vector<double> ticks_;
};

}  // namespace tilepress
