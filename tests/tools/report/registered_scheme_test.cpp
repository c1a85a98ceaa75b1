// A scheme that registers itself is on the report page and in gem5's statistics with its own label and
// columns.
#include <gtest/gtest.h>

#include "report/export/gem5_stats.h"
#include "report_page.h"
#include "scheme_names.h"

namespace tilepress {
namespace {

constexpr const char* kToyColumns[] = {"toy_hits", "toy_misses"};
constexpr const char* kMixColumns[] = {"toy_blocks", "red_blocks"};

/// No run of this test encodes anything.
SchemeInfo scheme_of(const char* name, const char* label, const char* family,
                     std::span<const char* const> columns) {
  SchemeInfo info{};
  info.name = name;
  info.label = label;
  info.family = family;
  info.summary = "A scheme of a test.";
  info.source = "this test";
  info.make_encoder = [](const SchemeSpec&, const FormatTraits&, const ModelOptions&) {
    return std::unique_ptr<BlockEncoder>();
  };
  info.make_decoder = [](const SchemeSpec&, const FormatTraits&, const ModelOptions&) {
    return std::unique_ptr<BlockDecoder>();
  };
  info.columns = columns;
  return info;
}

class RegisteredScheme : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (find_scheme("toy") != nullptr) return;  // --gtest_repeat
    ASSERT_TRUE(register_scheme(scheme_of("toy", "Toy <1>", "toys", kToyColumns)));
    ASSERT_TRUE(register_scheme(scheme_of("mix", "Mix", "mixed", kMixColumns)));
  }

  /// 100 blocks at a rate of 2.
  static SchemeStatistics sums(OwnCounts own) {
    SchemeStatistics sum;
    sum.blocks = 100;
    sum.raw_bits = 204800;
    sum.bursts = 800;
    sum.payload_bits = 102400;
    sum.own = own;
    return sum;
  }

  static std::string page() {
    RunSummary run;
    run.name = "load";
    run.measured = 1;
    run.schemes = {"toy", "mix"};
    run.totals = {sums({7, 5}), sums({75, 25})};
    Batch batch;
    batch.runs = {run};
    arrange_batch(batch);
    return report_page(batch, "title");
  }
};

TEST_F(RegisteredScheme, HasItsRatesAndColumnsOnThePage) {
  const std::string html = page();
  EXPECT_NE(html.find("<section id=\"toys\">\n<h2>Toy &lt;1&gt;: columns of its own</h2>"),
            std::string::npos);
  EXPECT_NE(html.find("data-h=\"toy hits\" data-v=\"7\""), std::string::npos);
  EXPECT_NE(html.find("data-h=\"toy misses\" data-v=\"5\""), std::string::npos);
  EXPECT_NE(html.find("data-h=\"rate toy\" data-v=\"2\""), std::string::npos);
}

TEST_F(RegisteredScheme, HasSharesOfItsBlocksUnderTheLabelsOfTheirCoders) {
  const std::string html = page();
  EXPECT_NE(html.find("<h2>Mix: blocks by coder</h2>"), std::string::npos);
  EXPECT_NE(html.find("coded by Toy &lt;1&gt;"), std::string::npos);
  EXPECT_NE(html.find("data-h=\"share RED\" data-v=\"0.25\""), std::string::npos);
  EXPECT_EQ(html.find("Toy <1>"), std::string::npos) << "a label must not become markup";
}

TEST_F(RegisteredScheme, HasItsColumnsInGem5Statistics) {
  RunRecord run;
  run.scheme_names = {"toy"};
  run.totals = {sums({7, 5})};
  const std::string text = gem5_stats(run, "load", false);
  EXPECT_NE(text.find("load.toy.toyHits "), std::string::npos) << text;
  EXPECT_NE(text.find("load.toy.toyMisses "), std::string::npos) << text;
}

TEST_F(RegisteredScheme, HasTheFamilyThatItNames) {
  EXPECT_EQ(scheme_family("toy:level=3"), "toys");
  EXPECT_EQ(scheme_family("no_such_scheme"), "");
}

}  // namespace
}  // namespace tilepress
