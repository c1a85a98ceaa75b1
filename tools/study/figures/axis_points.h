// Axis points: the values of an axis and the configurations that stand for them.
#pragma once

#include <string>
#include <vector>

#include "study/figures/study_data.h"

namespace tilepress {

struct AxisPoint {
  std::string value, configuration;
};

/// The points of an axis. The scheme with its defaults joins its own axis where the study has its results:
/// "vdcp" is the point 64 of an axis over fvc. Numbers ascend and other texts keep their order.
std::vector<AxisPoint> axis_points(const StudyData& data, const FigureAxis& axis);

/// How an axis of these values is drawn: "categories" if a value is no number, "log2" if they span a factor
/// of 16 or more in powers of two, otherwise "linear".
std::string axis_scale(const std::vector<AxisPoint>& points);

}  // namespace tilepress
