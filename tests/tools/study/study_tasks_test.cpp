// Tasks: chunks, shards and names of files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "study/result_store.h"
#include "study/study_plan.h"

namespace tilepress {
namespace {

std::vector<SchemeSpec> specs(const std::vector<std::string>& texts) {
  std::vector<SchemeSpec> out;
  for (const std::string& text : texts) out.push_back(*parse_scheme(text));
  return out;
}

TEST(Chunks, HoldEachConfigurationOnceAndKeepThoseThatShareTablesTogether) {
  const auto study = parse_study(built_in_study("paper"));
  for (const size_t size : {1u, 5u, 14u, 42u, 100u}) {
    std::multiset<size_t> seen;
    std::map<size_t, size_t> chunk_of;
    const auto chunks = chunk_configurations(study->configurations, size);
    for (size_t i = 0; i < chunks.size(); ++i)
      for (const size_t configuration : chunks[i]) {
        seen.insert(configuration);
        chunk_of[configuration] = i;
      }
    EXPECT_EQ(seen.size(), study->configurations.size());
    EXPECT_EQ(std::set<size_t>(seen.begin(), seen.end()).size(), seen.size());
    // dcp, adcp, vdcp and huffdcp are the first four of the study and use one FVC.
    EXPECT_EQ(chunk_of[0], chunk_of[1]);
    EXPECT_EQ(chunk_of[0], chunk_of[3]);
    if (size >= study->configurations.size()) {
      EXPECT_EQ(chunks.size(), 1u);
    }
  }
}

TEST(Chunks, OfOneHoldGroupsThatShareTables) {
  const auto chunks = chunk_configurations(specs({"vdcp:fvc=16", "ras", "dcp:fvc=16", "red"}), 1);
  EXPECT_THAT(chunks, testing::ElementsAre(testing::ElementsAre(0, 2), testing::ElementsAre(1),
                                           testing::ElementsAre(3)));
}

TEST(Shards, TakeEachTaskOnce) {
  for (uint32_t count = 1; count < 6; ++count)
    for (size_t task = 0; task < 20; ++task) {
      int takers = 0;
      for (uint32_t index = 1; index <= count; ++index) takers += Shard{index, count}.takes(task);
      EXPECT_EQ(takers, 1);
    }
}

TEST(ResultNames, DependOnFramesConfigurationAndOptionsAlone) {
  RunOptions options;
  const ResultStore store("out", options, "w", "f");
  const SchemeSpec vdcp = *parse_scheme("vdcp"), same = *parse_scheme("vdcp:fvc=64");
  EXPECT_EQ(store.result_path(vdcp), store.result_path(same));
  std::set<std::string> keys = {store.result_key(vdcp),
                                ResultStore("out", options, "w", "g").result_key(vdcp),
                                store.result_key(*parse_scheme("vdcp:fvc=32"))};
  options.model.burst_bits = 256;
  keys.insert(ResultStore("out", options, "w", "f").result_key(vdcp));
  options = RunOptions();
  options.every = 2;
  keys.insert(ResultStore("out", options, "w", "f").result_key(vdcp));
  EXPECT_EQ(keys.size(), 5u);
}

TEST(ResultNames, OfMetricsDependOnFramesAndWhichAreModelled) {
  const auto metrics = [](const RunOptions& options) {
    return ResultStore("out", options, "w", "f").frames_path();
  };
  RunOptions options;
  options.model.burst_bits = 256;
  options.model.tile_side = 64;
  EXPECT_EQ(metrics(options), metrics({}));
  options.every = 3;
  EXPECT_NE(metrics(options), metrics({}));
}

}  // namespace
}  // namespace tilepress
