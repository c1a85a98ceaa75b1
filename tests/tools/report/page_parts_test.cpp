// Tests of the report's sums, order and markup.
#include "page_parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sections.h"

namespace tilepress {
namespace {

RunSummary run_of(const std::string& name, const std::string& category, uint64_t moved_bursts) {
  RunSummary run;
  run.name = name;
  run.category = category;
  run.measured = 1;
  run.schemes = {"dcp"};
  SchemeStatistics sum;
  sum.blocks = 100;
  sum.raw_bits = 204800;
  sum.bursts = moved_bursts;
  sum.payload_bits = moved_bursts * 128;
  run.totals = {sum};
  return run;
}

TEST(HarmonicMean, IsTheCountOverTheSumOfInverses) {
  // 2 / (1/2 + 1/6) = 3.
  EXPECT_DOUBLE_EQ(harmonic_mean({2, 6}), 3);
  EXPECT_DOUBLE_EQ(harmonic_mean({5.26}), 5.26);
  EXPECT_DOUBLE_EQ(harmonic_mean({2, NAN, 6}), 3);
  EXPECT_TRUE(std::isnan(harmonic_mean({})));
}

TEST(Energy, GivesThePapersSavingsFromItsRates) {
  const Batch batch;
  // 1 - 1/5.26 - 4.83/451.2 = 0.79918; 1 - 1/1.75 - 4.83/451.2 = 0.41787.
  EXPECT_NEAR(energy_saving(5.26, batch.energy), 0.799, 0.0005);
  EXPECT_NEAR(energy_saving(1.75, batch.energy), 0.418, 0.0005);
}

TEST(Batch, RunsStandByCategoryAndInItByTheBaselinesRate) {
  Batch batch;
  batch.runs = {run_of("fast game", "3D", 200), run_of("plain", "", 100),      run_of("slow ui", "UI", 800),
                run_of("fast ui", "UI", 100),   run_of("other", "video", 100), run_of("puzzle", "2D", 100)};
  arrange_batch(batch);
  std::vector<std::string> names;
  for (const RunSummary& run : batch.runs) names.push_back(run.name);
  EXPECT_EQ(names, (std::vector<std::string>{"slow ui", "fast ui", "puzzle", "fast game", "other", "plain"}));
  EXPECT_EQ(batch.categories, (std::vector<std::string>{"UI", "2D", "3D", "video", ""}));
  EXPECT_EQ(batch.baseline, "dcp");
}

TEST(Batch, RatesOfACategoryLeaveOutRunsWithoutTheScheme) {
  Batch batch;
  batch.runs = {run_of("a", "UI", 800), run_of("b", "UI", 400), run_of("c", "UI", 400)};
  batch.runs[2].schemes = {"ras"};
  arrange_batch(batch);
  // 204800 / (800 * 128) = 2 and 204800 / (400 * 128) = 4.
  EXPECT_EQ(batch.rates("UI", "dcp", true), (std::vector<double>{2, 4}));
}

TEST(HtmlText, NamesFromOutsideCannotBecomeMarkup) {
  EXPECT_EQ(escape_html("<a href='x'>&\""), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
  EXPECT_EQ(file_slug("vdcp:fvc=128/../x"), "vdcp_fvc_128_.._x");
  Batch batch;
  batch.runs = {run_of("<script>alert(1)</script>", "<b>", 100)};
  arrange_batch(batch);
  for (const Section& section : page_sections(batch))
    EXPECT_EQ(section_html(section).find("<script"), std::string::npos);
  EXPECT_EQ(run_parts(batch).find("<script"), std::string::npos);
}

TEST(HtmlText, SlotsAreFilledOnceAndUnknownOnesVanish) {
  EXPECT_EQ(fill_slots("a {{x}} b {{y}} {{z}}", {{"x", "{{y}}"}, {"y", "2"}}), "a {{y}} b 2 ");
}

TEST(Table, CellsCarryTheirExactValue) {
  Table table{.name = "t",
              .caption = "c",
              .header = {"name", "rate"},
              .rows = {{text_cell("a"), number_cell(1.0 / 3)}}};
  const std::string html = table_html(table);
  EXPECT_NE(html.find("data-v=\"0.3333333333333333\">0.333</td>"), std::string::npos) << html;
}

TEST(AxisScale, CoversItsValuesWithTicksAtBothEnds) {
  for (const double high : {0.4, 1.0, 3.7, 15.9, 42.0, 1000.0}) {
    const AxisScale axis = AxisScale::for_rates(0.9 * std::min(high, 1.0), high);
    EXPECT_GE(axis.ticks().size(), 3u) << high;
    EXPECT_LE(axis.ticks().size(), 12u) << high;
    EXPECT_LE(axis.percent(high), 100) << high;
    EXPECT_DOUBLE_EQ(axis.percent(axis.ticks().front()), 0) << high;
    EXPECT_DOUBLE_EQ(axis.percent(axis.ticks().back()), 100) << high;
    EXPECT_LE(high, axis.ticks().back() * 1.000001) << high;
  }
  // On a logarithmic axis from 0.5 to 32, 4 = 2^2 stands at (2 - -1) / (5 - -1) = 50 %.
  EXPECT_DOUBLE_EQ(AxisScale::for_rates(0.9, 20).percent(4), 50);
}

}  // namespace
}  // namespace tilepress
