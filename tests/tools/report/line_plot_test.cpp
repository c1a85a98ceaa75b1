// Tests of the line plots' reduction and JSON.
#include "line_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tilepress {
namespace {

LinePlot plot_of(size_t count) {
  LinePlot plot;
  plot.lines = {{"sine", 0, {}}, {"spike", 1, {}}};
  for (size_t i = 0; i < count; ++i) {
    plot.x.push_back(static_cast<double>(i));
    plot.lines[0].y.push_back(std::sin(static_cast<double>(i) / 100));
    plot.lines[1].y.push_back(i == 777 ? 9.0 : 1.0);
  }
  return plot;
}

TEST(LinePlot, AShortPlotIsLeftAsItIs) {
  LinePlot plot = plot_of(50);
  EXPECT_EQ(reduce_line_plot(plot, 50), 1u);
  EXPECT_EQ(plot.x.size(), 50u);
}

TEST(LinePlot, ALongPlotFitsTheLimitAndKeepsEveryExtreme) {
  LinePlot plot = plot_of(10000);
  // 100 points are 50 columns of 10000 / 50 = 200 values.
  EXPECT_EQ(reduce_line_plot(plot, 100), 200u);
  EXPECT_EQ(plot.x.size(), 100u);
  EXPECT_EQ(plot.lines[0].y.size(), 100u);
  EXPECT_TRUE(std::is_sorted(plot.x.begin(), plot.x.end()));
  EXPECT_EQ(plot.x.front(), 0);
  EXPECT_EQ(plot.x.back(), 9999);
  EXPECT_EQ(*std::max_element(plot.lines[1].y.begin(), plot.lines[1].y.end()), 9.0);
  EXPECT_EQ(std::count(plot.lines[1].y.begin(), plot.lines[1].y.end(), 9.0), 1);
}

TEST(LinePlot, ValuesKeptAreValuesOfTheInput) {
  const LinePlot full = plot_of(1003);
  LinePlot plot = full;
  reduce_line_plot(plot, 40);
  for (const double value : plot.lines[0].y)
    EXPECT_NE(std::find(full.lines[0].y.begin(), full.lines[0].y.end(), value), full.lines[0].y.end())
        << value;
}

TEST(LinePlot, TheLastColumnMayHoldOneValue) {
  LinePlot plot = plot_of(11);
  // 4 points are 2 columns of 6 values; of 3 points one column of 11; of 20 points nothing is reduced.
  EXPECT_EQ(reduce_line_plot(plot, 4), 6u);
  EXPECT_EQ(plot.x, (std::vector<double>{0, 5, 6, 10}));
  plot = plot_of(11);
  EXPECT_EQ(reduce_line_plot(plot, 10), 3u);
  EXPECT_EQ(plot.x, (std::vector<double>{0, 2, 3, 5, 6, 8, 9, 10}));
  plot = plot_of(10);
  EXPECT_EQ(reduce_line_plot(plot, 8), 3u);
  EXPECT_EQ(plot.x, (std::vector<double>{0, 2, 3, 5, 6, 8, 9})) << "a column of one value has one point";
}

TEST(LinePlot, AColumnWithoutValuesIsAGap) {
  LinePlot plot;
  plot.x = {0, 1, 2, 3};
  plot.lines = {{"gap", 0, {NAN, NAN, 2, NAN}}};
  EXPECT_EQ(reduce_line_plot(plot, 2), 4u);
  EXPECT_EQ(plot.lines[0].y, (std::vector<double>{2, 2}));
  plot.x = {0, 1, 2, 3};
  plot.lines = {{"gap", 0, {NAN, NAN, 2, 5}}};
  EXPECT_EQ(reduce_line_plot(plot, 3), 4u);
  plot.x = {0, 1};
  plot.lines = {{"gap", 0, {NAN, 2}}};
  EXPECT_NE(line_plot_json(plot).find("\"y\":[null,2]"), std::string::npos);
}

TEST(LinePlot, JsonCannotEndItsScriptElement) {
  LinePlot plot;
  plot.title = "</script><b>\"\\";
  plot.lines = {{"<x>", 0, {}}};
  const std::string json = line_plot_json(plot);
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_NE(json.find("\\u003c/script>\\u003cb>\\u0022\\u005c"), std::string::npos);
}

}  // namespace
}  // namespace tilepress
