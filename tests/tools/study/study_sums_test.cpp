// Sums over rows, and the shares of colours.
#include <gtest/gtest.h>

#include "study/color_shares.h"
#include "study/result_rows.h"

namespace tilepress {
namespace {

constexpr const char* kHeader =
    "frame,surface,scheme,warmup,blocks,raw_bits,payload_bits,bursts,csb_bits,palette_bits,rate_payload,rate";

TEST(ResultRows, OfAllSurfacesAddUpWithoutWarmUpAndTargets) {
  const auto sums = sum_result_rows(std::string(kHeader) +
                                        "\n0,0,vdcp,1,10,20480,20480,160,0,0,1,1\n"
                                        "1,0,vdcp,0,10,20480,5000,40,480,2112,1,1\n"
                                        "1,1000000,vdcp,0,10,20480,5000,40,480,2112,1,1\n"
                                        "1,1,vdcp,0,5,10240,2000,20,240,2112,1,1\n",
                                    128, true);
  ASSERT_TRUE(sums) << sums.error().text;
  EXPECT_EQ(sums->frames, 2u);
  EXPECT_EQ(sums->total.raw_bits, 30720u);
  EXPECT_EQ(sums->total.moved_bits(), 60u * 128 + 720 + 4224);
  EXPECT_DOUBLE_EQ(sums->each[1].rate, 10240.0 / (20 * 128 + 240 + 2112));
}

TEST(ResultRows, OfOlderVersionsLackColumns) {
  const auto sums = sum_result_rows(std::string(kHeader) + "\n1,0,hdcp,0,10,20480,5000,40,480,2112,1,1\n", 128, false);
  ASSERT_TRUE(sums) << sums.error().text;
  EXPECT_FALSE(sums->fvc_coverage.mean());
  for (const auto& count : sums->own) EXPECT_FALSE(count);
  EXPECT_TRUE(sums->each.empty());
}

TEST(ResultRows, MeanCoverageIsOverTheFramesThatHaveOne) {
  const std::string text = std::string(kHeader) +
                           ",fvc_coverage,fvc_relative_coverage\n"
                           "1,0,vdcp,0,10,20480,5000,40,480,2112,1,1,0.5,0.75\n"
                           "2,0,vdcp,0,10,20480,5000,40,480,2112,1,1,,\n"
                           "3,0,vdcp,0,10,20480,5000,40,480,2112,1,1,1,1\n";
  const auto sums = sum_result_rows(text, 128, false);
  ASSERT_TRUE(sums) << sums.error().text;
  EXPECT_EQ(sums->fvc_coverage.mean(), 0.75);
  EXPECT_EQ(sums->fvc_relative_coverage.mean(), 0.875);
}

TEST(ResultRows, ThatCannotBeReadAreNamed) {
  const auto sums = sum_result_rows(std::string(kHeader) + "\n1,0,vdcp,0,ten,0,0,0,0,0,1,1\n", 128, false);
  ASSERT_FALSE(sums);
  EXPECT_EQ(sums.error().text, "record 2: blocks: cannot read 'ten'");
}

/// A row of pixels: `counts[i]` pixels of colour i.
std::vector<uint32_t> row_of(const std::vector<uint32_t>& counts) {
  std::vector<uint32_t> row;
  for (uint32_t color = 0; color < counts.size(); ++color) row.insert(row.end(), counts[color], color);
  return row;
}

void add_row(ColorShares& shares, const std::vector<uint32_t>& row) {
  SurfaceView view;
  view.top_row = reinterpret_cast<const std::byte*>(row.data());
  view.width = static_cast<uint32_t>(row.size());
  view.height = 1;
  view.pitch_bytes = static_cast<ptrdiff_t>(row.size() * sizeof(uint32_t));
  view.format = PixelFormat::kRgba8;
  shares.add(view);
}

TEST(ColorShares, AreMeansOverFramesUpToTheCountThatCoversAll) {
  ColorShares shares;
  add_row(shares, row_of({6, 3, 1}));  // 0.6, 0.9, 1
  add_row(shares, row_of({10}));       // 1
  EXPECT_EQ(shares.text(), "colors,pixels_share\n1,0.8\n2,0.95\n3,1\n");
  EXPECT_EQ(ColorShares().text(), "colors,pixels_share\n");
}

TEST(ColorShares, StepByTensFromTenOn) {
  ColorShares shares;
  add_row(shares, row_of(std::vector<uint32_t>(25, 4)));
  EXPECT_NE(shares.text().find("\n9,0.36\n10,0.4\n20,0.8\n30,1\n"), std::string::npos) << shares.text();
}

}  // namespace
}  // namespace tilepress
