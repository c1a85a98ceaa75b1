// The cost model gives the paper's figures.
#include "tilepress/cost_model.h"

#include <gtest/gtest.h>

namespace tilepress {
namespace {

// Paper §Energy savings: VDCP's rates 5.26 (UI), 2.90 (2D) and 1.75 (3D).
TEST(CostModel, SavesThePapersShareOfEnergy) {
  EXPECT_NEAR(energy_saving(5.26), 0.799, 0.0005);
  EXPECT_NEAR(energy_saving(2.90), 0.644, 0.0005);
  EXPECT_NEAR(energy_saving(1.75), 0.418, 0.0005);
  // 1 − 1/2 − 4.83/451.2 = 0.489295…
  EXPECT_NEAR(energy_saving(2), 0.4892952, 1e-7);
  EXPECT_LT(energy_saving(1), 0) << "structures cost something even where nothing is saved";
}

TEST(CostModel, TakesOtherConstants) {
  CostConstants constants;
  constants.dram_pj_per_byte = 100;
  constants.structures_pj_per_byte = 10;
  EXPECT_DOUBLE_EQ(energy_saving(4, constants), 0.65);
  EXPECT_DOUBLE_EQ(dram_power_mw(1e9, constants), 100) << "1 GB/s × 100 pJ/B = 0.1 W";
  EXPECT_DOUBLE_EQ(compressed_power_mw(1e9, 4, constants), 35) << "25 mW of DRAM and 10 of structures";
}

// 720 · 1280 · 4 bytes · 60 Hz · 2 passes = 442368000 bytes/s; × 451.2 pJ/B = 199.6 mW.
TEST(CostModel, GivesThePapersDynamicPowerForThePapersDisplay) {
  SurfaceLoad display;
  display.width = 720;
  display.height = 1280;
  EXPECT_DOUBLE_EQ(display.raw_bytes_per_s(), 442368000);
  EXPECT_NEAR(dram_power_mw(display.raw_bytes_per_s()), 199.6, 0.01);
  // The 949.21 MB/s that the paper prints beside it is another size, in MiB/s: 1920 · 1080 · 4 bytes · 60 Hz · 2 passes = 995328000 bytes/s = 949.21 MiB/s
  EXPECT_DOUBLE_EQ(SurfaceLoad{}.raw_bytes_per_s(), 995328000);
  EXPECT_NEAR(SurfaceLoad{}.raw_bytes_per_s() / (1 << 20), 949.21, 0.01);
}

TEST(CostModel, StoresWhatThePaperSays) {
  EXPECT_EQ(fvc_storage_bits(64, 32, 4096ull * 4096) / 8, 456u) << "64 · (32 + 1 + 24) / 8";
  EXPECT_EQ(ccd_storage_bits(64, 32) / 8, 264u) << "64 · 33 / 8";
  EXPECT_EQ(fvc_storage_bits(64, 32, 1920 * 1080), 64u * (33 + 21)) << "2073600 < 2^21 = 2097152";
  EXPECT_EQ(fvc_storage_bits(128, 16, 4096ull * 4096 + 1), 128u * (17 + 25)) << "one pixel more than 2^24";
  EXPECT_EQ(fvc_storage_bits(2, 32, 1), 66u);
}

TEST(CostModel, TakesThePapersAreaForSixteenSurfaces) {
  EXPECT_NEAR(structures_area_mm2(64, 16), 0.009527672, 1e-12);
  EXPECT_NEAR(structures_area_mm2(64, 1), 0.00304232 + 0.00197988 + 0.000281592, 1e-12);
  EXPECT_NEAR(structures_area_mm2(128, 16), 2 * 0.009527672, 1e-12) << "linear in the entries";
}

TEST(CostModel, TellsWhetherTheStructuresKeepUp) {
  // 4096 · 4096 · 60 = 1006.6 MPixel/s: far below 7241.
  EXPECT_TRUE(check_bandwidth({.width = 4096, .height = 4096, .refresh_hz = 60}, 1).suffices());
  // 16384 · 16384 · 30 = 8053 MPixel/s: above FVC (7241) and CCD (7431), below rCCD (13203).
  const SurfaceLoad huge{.width = 16384, .height = 16384, .refresh_hz = 30};
  const BandwidthCheck every = check_bandwidth(huge, 1);
  EXPECT_NEAR(every.ccd_needed, 8053.06, 0.01);
  EXPECT_FALSE(every.fvc_suffices);
  EXPECT_FALSE(every.ccd_suffices);
  EXPECT_TRUE(every.rccd_suffices);
  EXPECT_FALSE(every.suffices());
  EXPECT_TRUE(check_bandwidth(huge, 2).fvc_suffices) << "every second pixel enters the FVC";
}

}  // namespace
}  // namespace tilepress
