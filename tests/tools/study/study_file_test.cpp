// Study files: configurations, axes, and errors.
#include "study/study_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "study/configuration.h"

namespace tilepress {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(const std::vector<SchemeSpec>& specs) {
  std::vector<std::string> out;
  for (const SchemeSpec& spec : specs) out.push_back(spec.text);
  return out;
}

TEST(Configuration, CanonicalTextHasOnlyKeysThatDifferInTheOrderOfTheTable) {
  EXPECT_EQ(canonical_text(*parse_scheme("vdcp:fvc=64,policy=lfc")), "vdcp");
  EXPECT_EQ(canonical_text(*parse_scheme("vdcp:sample=4,policy=2lfc,fvc=16")), "vdcp:fvc=16,policy=2lfc,sample=4");
  EXPECT_EQ(canonical_text(*parse_scheme("vdcp:coverage=0.5")), "vdcp:coverage=0.5");
  EXPECT_EQ(canonical_text(*parse_scheme("ras:ycocg=1,sizes=burst")), "ras:ycocg=1,sizes=burst");
}

TEST(Configuration, EqualConfigurationsAreOneUnderTheFirstName) {
  ConfigurationList list;
  EXPECT_EQ(list.add(*parse_scheme("vdcp:fvc=64")), "vdcp:fvc=64");
  EXPECT_EQ(list.add(*parse_scheme("vdcp")), "vdcp:fvc=64");
  EXPECT_EQ(list.specs().size(), 1u);
}

TEST(StudyFile, ThePaperHasFortyTwoConfigurations) {
  const auto study = parse_study(built_in_study("paper"));
  ASSERT_TRUE(study) << study.error().text;
  // vdcp and dcp at 64, five further sizes each, six associativities, three policies, seven sampling rates, eight
  // periods, and six other schemes.
  EXPECT_EQ(study->configurations.size(), 2u + 10 + 6 + 3 + 7 + 8 + 6);
  EXPECT_EQ(study->baseline, "vdcp");
  for (const StudyAxis& axis : study->axes) {
    EXPECT_EQ(axis.values.size(), axis.configurations.size());
    const auto base = axis.scheme == "dcp" ? "dcp" : "vdcp";
    EXPECT_EQ(std::ranges::count(axis.configurations, base), 1) << axis.name;
  }
}

TEST(StudyFile, AnAxisPassesThroughTheBase) {
  const auto study = parse_study(
      "name = \"x\"\nconfigurations = [\"vdcp\"]\n[[axis]]\nname = \"a\"\nscheme = \"vdcp\"\nkey = \"fvc\"\n"
      "values = [32, 64]\nfixed = \"policy=lfc\"\n");
  ASSERT_TRUE(study) << study.error().text;
  EXPECT_THAT(texts(study->configurations), ElementsAre("vdcp", "vdcp:fvc=32"));
  EXPECT_THAT(study->axes[0].configurations, ElementsAre("vdcp:fvc=32", "vdcp"));
}

TEST(StudyFile, ListsInBracesAreConfigurations) {
  const auto study = parse_study("name = \"x\"\nconfigurations = [\"ras\", \"vdcp:fvc={32..128}\"]\n");
  ASSERT_TRUE(study) << study.error().text;
  EXPECT_THAT(texts(study->configurations), ElementsAre("ras", "vdcp:fvc=32", "vdcp:fvc=64", "vdcp:fvc=128"));
}

TEST(StudyFile, TheExampleParses) {
  const auto study = parse_study(example_study());
  ASSERT_TRUE(study) << study.error().text;
  EXPECT_TRUE(study->remarks.empty());
  EXPECT_EQ(study->axes.size(), 2u);
  EXPECT_NE(study->figures_json.find("\"fvc-size\""), std::string::npos);
}

TEST(StudyFile, NamesThatOccurTwiceAreRefused) {
  const std::string axis = "[[axis]]\nname = \"a\"\nscheme = \"vdcp\"\nkey = \"fvc\"\nvalues = [32]\n";
  const auto twice = parse_study("name = \"x\"\n" + axis + axis);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().text, "line 7: the axis 'a' is there twice");
}

}  // namespace
}  // namespace tilepress
