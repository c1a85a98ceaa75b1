// Tests of a study's figures: rows with derived numbers, from small studies.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "study/figures/axis_points.h"
#include "study/figures/figure.h"
#include "study/figures/study_data.h"

namespace tilepress {
namespace {

/// A folder with the files of a study, removed at the end.
class StudyFolder : public testing::Test {
 protected:
  StudyFolder() {
    std::string pattern = testing::TempDir() + "/study-XXXXXX";
    path_ = mkdtemp(pattern.data());
    write("study.json", R"({"name": "s", "title": "S", "baseline": "vdcp",
      "categories": [{"name": "UI", "title": "User interfaces"}, {"name": "3D", "title": "Games"}],
      "axes": [{"name": "fvc", "title": "FVC entries", "scheme": "vdcp", "key": "fvc", "values": [128, 32],
                "configurations": ["vdcp:fvc=128", "vdcp:fvc=32"]}]})");
    // Rates of vdcp: 2 and 6 in UI, 1 in 3D. Harmonic mean of UI: 2 / (1/2 + 1/6) = 3.
    // Rates of vdcp:fvc=32: 1 and 3: mean 1.5. Rates of vdcp:fvc=128: 4 and 6: mean 4.8.
    write("results.csv",
          "workload,category,configuration,scheme,fvc,rate,rate_payload,fvc_coverage,vdcp_blocks,ras_blocks,"
          "raw_blocks\n"
          "\"b,1\",UI,vdcp,vdcp,64,6,7,0.9,,,\n\"b,1\",UI,vdcp:fvc=32,vdcp,32,3,3,0.9,,,\n"
          "\"b,1\",UI,vdcp:fvc=128,vdcp,128,6,6,0.9,,,\n"
          "\"b,1\",UI,dcp,dcp,64,5,5,0.9,,,\n\"b,1\",UI,hdcp,hdcp,64,7,7,0.9,30,10,6\n"
          "a,UI,vdcp,vdcp,64,2,2,0.8,,,\na,UI,vdcp:fvc=32,vdcp,32,1,1,0.8,,,\na,UI,vdcp:fvc=128,vdcp,128,4,4,"
          "0.8,,,\n"
          "a,UI,dcp,dcp,64,1.5,1.5,0.8,,,\na,UI,hdcp,hdcp,64,3,3,0.8,30,10,\n"
          "c,3D,vdcp,vdcp,64,1,1,0.2,,,\nc,3D,dcp,dcp,64,0.9,0.9,0.2,,,\n");
    write("means.csv",
          "category,configuration,scheme,fvc,workloads,rate_hmean,rate_payload_hmean\n"
          "UI,vdcp,vdcp,64,2,3,3\nUI,vdcp:fvc=32,vdcp,32,2,1.5,1.5\nUI,vdcp:fvc=128,vdcp,128,2,4.8,4.8\n"
          "3D,vdcp,vdcp,64,1,1,1\nall,vdcp,vdcp,64,3,1.8,1.8\n");
    write("workloads.csv",
          "workload,category,status,reason,frames,entropy\n\"b,1\",UI,done,,10,3\na,UI,done,,10,5\nc,3D,done,"
          ",10,12\n"
          "d,UI,failed,no frames,0,\n");
  }
  ~StudyFolder() override { std::filesystem::remove_all(path_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(path_ + "/" + name) << text; }
  StudyData data() {
    auto read = read_study_data(path_);
    EXPECT_TRUE(read) << read.error().text;
    return std::move(*read);
  }
  FigureSpec axis_spec() {
    return {.name = "f", .kind = "rate over an axis", .title = "", .axis = "fvc", .normalized_to = "vdcp"};
  }

  std::string path_;
};

TEST_F(StudyFolder, TheDefaultConfigurationJoinsItsAxisAndNumbersAscend) {
  const StudyData study = data();
  std::vector<std::string> points;
  for (const AxisPoint& point : axis_points(study, study.spec.axes[0]))
    points.push_back(point.value + "=" + point.configuration);
  EXPECT_EQ(points, (std::vector<std::string>{"32=vdcp:fvc=32", "64=vdcp", "128=vdcp:fvc=128"}));
}

TEST(AxisScale, PowersOfTwoOverAFactorOfSixteenAreLogarithmicAndWordsAreCategories) {
  EXPECT_EQ(axis_scale({{"16", ""}, {"64", ""}, {"256", ""}}), "log2");
  EXPECT_EQ(axis_scale({{"16", ""}, {"64", ""}}), "linear");
  EXPECT_EQ(axis_scale({{"1", ""}, {"2", ""}, {"60", ""}}), "linear");
  EXPECT_EQ(axis_scale({{"1", ""}, {"full", ""}}), "categories");
}

TEST_F(StudyFolder, ARelativeAxisDividesTheMeansAndTheRatesOfEachWorkload) {
  const auto figure = make_figure(data(), axis_spec());
  ASSERT_TRUE(figure) << figure.error().text;
  const StudyTable& table = figure->table;
  ASSERT_EQ(table.rows.size(), 4u);  // three of UI, and vdcp alone of 3D
  // fvc=128: 4.8 / 3 = 1.6; of the workloads: 6 / 6 and 4 / 2.
  EXPECT_EQ(table.text(2, "fvc"), "128");
  EXPECT_DOUBLE_EQ(table.number(2, "relative_rate"), 1.6);
  EXPECT_EQ(table.number(2, "minimum"), 1);
  EXPECT_EQ(table.number(2, "median"), 1.5);
  EXPECT_EQ(table.number(2, "maximum"), 2);
  EXPECT_EQ(table.number(1, "relative_rate"), 1);
  EXPECT_EQ(table.text(3, "category"), "3D");
}

TEST_F(StudyFolder, PublishedValuesStandBesideTheirValueAndBringTheirCategory) {
  FigureSpec spec = axis_spec();
  spec.published = {{"64", "all", 0.5}, {"32", "UI", 0.25}};
  const auto figure = make_figure(data(), spec);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->table.number(0, "published"), 0.25);
  EXPECT_TRUE(std::isnan(figure->table.number(1, "published")));
  EXPECT_EQ(figure->table.text(4, "category"), "all");
  EXPECT_EQ(figure->table.number(4, "published"), 0.5);
}

TEST_F(StudyFolder, WorkloadsStandByCategoryAndInItByTheRateOfDcp) {
  const auto figure =
      make_figure(data(), {.name = "f", .kind = "rates of workloads", .configurations = {"dcp"}});
  ASSERT_TRUE(figure);
  EXPECT_EQ(
      figure->table.csv(),
      "workload,category,order,configuration,rate\na,UI,1,dcp,1.5\n\"b,1\",UI,2,dcp,5\nc,3D,3,dcp,0.9\n");
}

TEST_F(StudyFolder, RawBlocksOfAHybridAreTakenFromThoseOfVdcp) {
  const auto figure = make_figure(data(), {.name = "f", .kind = "hybrid shares"});
  ASSERT_TRUE(figure);
  const StudyTable& table = figure->table;
  ASSERT_EQ(table.rows.size(), 2u);
  // "a" has no count of raw blocks: 30 of 40. "b,1": 30 − 6 of 40, 6 of 40, 10 of 40.
  EXPECT_EQ(table.number(0, "vdcp_only"), 0.75);
  EXPECT_EQ(table.text(0, "raw_share"), "");
  EXPECT_EQ(table.number(1, "vdcp_share"), 0.75);
  EXPECT_EQ(table.number(1, "vdcp_only"), 0.6);
  EXPECT_EQ(table.number(1, "raw_share"), 0.15);
  EXPECT_EQ(table.number(1, "ras_only"), 0.25);
}

TEST_F(StudyFolder, AFigureThatCannotBeMadeSaysWhy) {
  const StudyData study = data();
  const auto reason = [&](const FigureSpec& spec) {
    const auto figure = make_figure(study, spec);
    return figure ? "" : figure.error().text;
  };
  EXPECT_EQ(reason({.name = "f", .kind = "pie"}), "figure f: there is no kind of figure 'pie'");
  EXPECT_EQ(reason({.name = "f", .kind = "rate over an axis", .axis = "x"}),
            "figure f: the study has no axis 'x'");
  EXPECT_EQ(reason({.name = "f", .kind = "colour CDF"}), "figure f: no workload has rows in color_cdf.csv");
  EXPECT_EQ(reason({.name = "f", .kind = "means", .configurations = {"red"}}),
            "figure f: the study has no results for it");
  EXPECT_EQ(reason({.name = "../f", .kind = "means"}),
            "figure '../f': a name has letters, digits, '.', '-' and '_' only");
}

TEST_F(StudyFolder, AStudyWithoutFiguresHasOnePerAxisTheRatesAndTheMeans) {
  std::vector<std::string> names;
  for (const FigureSpec& spec : figure_specs(data())) names.push_back(spec.name);
  EXPECT_EQ(names, (std::vector<std::string>{"fvc", "rates", "means"}));
}

TEST_F(StudyFolder, TornFilesAreErrorsThatNameTheFile) {
  write("means.csv", "category,configuration\nUI\n");
  EXPECT_EQ(read_study_data(path_).error().text,
            path_ + "/means.csv: record 2 has 1 fields, the header has 2");
  std::filesystem::remove(path_ + "/means.csv");
  EXPECT_EQ(read_study_data(path_).error().text, path_ + "/means.csv: cannot be opened");
  write("study.json", "{");
  EXPECT_TRUE(read_study_data(path_).error().text.starts_with(path_ + "/study.json: "));
}

}  // namespace
}  // namespace tilepress
