// Axis scale: nice steps of 1, 2 and 5 for linear axes, powers of two for logarithmic ones.
#include "axis_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepress {

AxisScale AxisScale::for_rates(double low, double high) {
  if (high > 16 && low > 0) {
    AxisScale axis;
    axis.logarithmic_ = true;
    axis.low_ = std::exp2(std::floor(std::log2(std::max(low, 1e-3))));
    axis.high_ = std::exp2(std::ceil(std::log2(high)));
    for (double tick = axis.low_; tick <= axis.high_; tick *= 2) axis.ticks_.push_back(tick);
    return axis;
  }
  double step = 0.1;
  for (const double candidate : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0})
    if (high / step > 8) step = candidate;
  return linear(std::max(step, std::ceil(high / step) * step), step);
}

AxisScale AxisScale::linear(double top, double step) {
  AxisScale axis;
  axis.high_ = top;
  for (int i = 0; i * step <= top * 1.0001; ++i) axis.ticks_.push_back(i * step);
  return axis;
}

double AxisScale::percent(double value) const {
  const double share = logarithmic_ ? (std::log2(std::max(value, low_)) - std::log2(low_)) /
                                          (std::log2(high_) - std::log2(low_))
                                    : (value - low_) / (high_ - low_);
  return std::clamp(share, 0.0, 1.0) * 100;
}

std::string AxisScale::tick_text(double tick) {
  return fmt::format("{:.4g}", tick);
}

}  // namespace tilepress
