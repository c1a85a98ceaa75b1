// Claim rules: the numbers, as the paper's text states them.
#include "study/figures/claims.h"
#include "tilepress/cost_model.h"

namespace tilepress {
namespace {

using enum ClaimUnit;
using enum ClaimSource;

constexpr const char* kTemporal = "Temporal Coherence";
constexpr const char* kColors = "Temporal Coherence, colours";
constexpr const char* kEnabling = "Dynamically Enabling DCP";
constexpr const char* kSchemes = "DCP Schemes";
constexpr const char* kOthers = "Comparing VDCP, RAS and RED";
constexpr const char* kFidelity = "Factors affecting FVC Fidelity";
constexpr const char* kCost = "Implementation Cost and Energy Savings";
constexpr const char* kHybrid = "Hybrid Schemes";
constexpr const char* kConclusion = "Conclusion";

constexpr const char* kFewApps = "The paper's mean is over four applications.";
constexpr const char* kNoCategory = "The paper names no category.";
constexpr const char* kRasRules = "The paper does not give RAS's bit layout; tilepress has its own.";
constexpr const char* kFromRates = "1 - 1/rate - 4.83/451.2, with the mean rate.";
constexpr const char* kNoRate =
    "1 - 1/rate - 4.83/451.2, with the mean rate. The paper's saving needs a rate of 2.90, which it does not "
    "print.";

constexpr uint32_t kEntries = 64, kColorBits = 32, kSurfaces = 16;
constexpr uint64_t kFourKPixels = 4096 * 4096;
constexpr double kBitsPerByte = 8, kBytesPerPixel = 4;

/// One access of FVC, CCD and rCCD, in pJ.
double access_pj() {
  const CostConstants constants;
  return constants.fvc.access_pj + constants.ccd.access_pj + constants.rccd.access_pj;
}

constexpr ClaimRule kRules[] = {
    {"color-change-3d", kTemporal, "colour change", kShare, 0.157, "3D", kWorkloadMean, "color_change", "",
     "", kFewApps},
    {"pixel-change-3d", kTemporal, "pixel change", kShare, 0.65, "3D", kWorkloadMean, "pixel_change", "", "",
     kFewApps},
    {"color-change-ui", kTemporal, "colour change", kShare, 0.033, "UI", kWorkloadMean, "color_change", "",
     "", kFewApps},
    {"pixel-change-ui", kTemporal, "pixel change", kShare, 0.145, "UI", kWorkloadMean, "pixel_change", "", "",
     kFewApps},
    {"top100-ui", kColors, "pixels in the top 100 colours, Twitter (over 80 %)", kShare, 0.80, "UI", kStandIn,
     "top100_coverage"},
    {"top100-3d", kColors, "pixels in the top 100 colours, Temple Run 2", kShare, 0.10, "3D", kStandIn,
     "top100_coverage"},
    {"entropy-ui", kColors, "entropy, Twitter", kBitsPerPixel, 4.5, "UI", kStandIn, "entropy"},
    {"entropy-3d", kColors, "entropy, Temple Run 2", kBitsPerPixel, 14, "3D", kStandIn, "entropy"},
    {"coverage-threshold", kEnabling, "lowest VDCP rate where FVC coverage is 0.7 or more (above 2)", kRate,
     2, "all", kLowestCovered, "rate", "vdcp", "", "The paper shows exceptions: Unwind and Super Hexagon."},
    {"vdcp-payload-ui", kSchemes, "mean rate of VDCP without bursts", kRate, 5.56, "UI", kMean,
     "rate_payload_hmean", "vdcp"},
    {"vdcp-payload-2d", kSchemes, "mean rate of VDCP without bursts", kRate, 3.02, "2D", kMean,
     "rate_payload_hmean", "vdcp"},
    {"huffdcp-payload-3d", kSchemes, "mean rate of HuffDCP without bursts", kRate, 1.80, "3D", kMean,
     "rate_payload_hmean", "huffdcp"},
    {"vdcp-best-3d", kSchemes, "highest rate of VDCP without bursts, Smashy Road", kRate, 10.63, "3D",
     kLargest, "rate_payload", "vdcp"},
    {"vdcp-ui", kOthers, "mean rate of VDCP", kRate, 5.26, "UI", kMean, "rate_hmean", "vdcp"},
    {"ras-ui", kOthers, "mean rate of RAS", kRate, 2.73, "UI", kMean, "rate_hmean", "ras", "", kRasRules},
    {"red-ui", kOthers, "mean rate of RED", kRate, 2.77, "UI", kMean, "rate_hmean", "red"},
    {"ras-3d", kOthers, "mean rate of RAS", kRate, 2.54, "3D", kMean, "rate_hmean", "ras", "", kRasRules},
    {"vdcp-3d", kOthers, "mean rate of VDCP", kRate, 1.75, "3D", kMean, "rate_hmean", "vdcp"},
    {"relative-coverage-16", kFidelity, "relative coverage of a 16-entry FVC", kShare, 0.94, "UI", kMean,
     "fvc_relative_coverage_mean", "vdcp:fvc=16"},
    {"relative-coverage-512", kFidelity, "relative coverage of a 512-entry FVC", kShare, 0.983, "UI", kMean,
     "fvc_relative_coverage_mean", "vdcp:fvc=512"},
    {"policy-lfc", kFidelity, "mean rate with LFC", kRate, 5.26, "UI", kMean, "rate_hmean", "vdcp"},
    {"policy-2lfc", kFidelity, "mean rate with 2LFC", kRate, 5.25, "UI", kMean, "rate_hmean",
     "vdcp:policy=2lfc"},
    {"policy-lru", kFidelity, "mean rate with LRU", kRate, 3.04, "UI", kMean, "rate_hmean",
     "vdcp:policy=lru"},
    {"policy-random", kFidelity, "mean rate with random replacement", kRate, 2.92, "UI", kMean, "rate_hmean",
     "vdcp:policy=random"},
    {"sampling-16-ui", kFidelity, "rate at 1:16 pixel sampling, relative to 1:1", kShare, 0.987, "UI",
     kRelative, "rate_hmean", "vdcp:sample=16", "vdcp"},
    {"sampling-16-2d", kFidelity, "rate at 1:16 pixel sampling, relative to 1:1", kShare, 1.02, "2D",
     kRelative, "rate_hmean", "vdcp:sample=16", "vdcp"},
    {"period-2", kFidelity, "rate at a frame sampling period of 2, relative to 1", kShare, 0.97, "all",
     kRelative, "rate_hmean", "vdcp:period=2", "vdcp", kNoCategory},
    {"period-50", kFidelity, "rate at a frame sampling period of 50, relative to 1", kShare, 0.446, "all",
     kRelative, "rate_hmean", "vdcp:period=50", "vdcp", kNoCategory},
    {"period-60", kFidelity, "rate at a frame sampling period of 60, relative to 1", kShare, 0.433, "all",
     kRelative, "rate_hmean", "vdcp:period=60", "vdcp", kNoCategory},
    {"fvc-storage", kCost, "storage of a 64-entry FVC for 4k x 4k pixels", kBytes, 456, "", kCostModel, "",
     "", "", "",
     [] { return static_cast<double>(fvc_storage_bits(kEntries, kColorBits, kFourKPixels)) / kBitsPerByte; }},
    {"ccd-storage", kCost, "storage of a 64-entry CCD", kBytes, 264, "", kCostModel, "", "", "", "",
     [] { return static_cast<double>(ccd_storage_bits(kEntries, kColorBits)) / kBitsPerByte; }},
    {"area", kCost, "area with support of 16 surfaces", kSquareMillimetres, 0.009527672, "", kCostModel, "",
     "", "", "", [] { return structures_area_mm2(kEntries, kSurfaces); }},
    {"access-energy", kCost, "dynamic energy of DCP per byte", kPicojoules, 1.3, "", kCostModel, "", "", "",
     "One access of FVC, CCD and rCCD takes 1.27 pJ and serves a pixel of 4 bytes.",
     [] { return access_pj() / kBytesPerPixel; }},
    {"dram-power", kCost, "dynamic DRAM power of the display at 60 frames a second", kMilliwatts, 199.6, "",
     kCostModel, "", "", "", "720 x 1280 RGBA8, written and read.",
     [] { return dram_power_mw(SurfaceLoad{.width = 720, .height = 1280}.raw_bytes_per_s()); }},
    {"saving-ui", kCost, "energy saved by VDCP", kShare, 0.799, "UI", kSaving, "rate_hmean", "vdcp", "",
     kFromRates},
    {"saving-2d", kCost, "energy saved by VDCP", kShare, 0.644, "2D", kSaving, "rate_hmean", "vdcp", "",
     kNoRate},
    {"saving-3d", kCost, "energy saved by VDCP", kShare, 0.418, "3D", kSaving, "rate_hmean", "vdcp", "",
     kFromRates},
    {"hdcp-ui", kHybrid, "mean rate of HDCP", kRate, 7.2, "UI", kMean, "rate_hmean", "hdcp"},
    {"hdcp-2d", kHybrid, "mean rate of HDCP", kRate, 5.206, "2D", kMean, "rate_hmean", "hdcp"},
    {"hdcp-3d", kHybrid, "mean rate of HDCP", kRate, 3.23, "3D", kMean, "rate_hmean", "hdcp"},
    {"hybrid-share", kHybrid, "blocks that VDCP codes (as many as RAS)", kShare, 0.5, "all", kHybridShare, "",
     "hdcp", "", "Blocks that are raw either way are left out where the results count them."},
    {"vdcp-over-ras-ui", kConclusion, "gain of VDCP over RAS", kShare, 0.93, "UI", kGain, "rate_hmean",
     "vdcp", "ras", kRasRules},
    {"vdcp-over-red-ui", kConclusion, "gain of VDCP over RED", kShare, 0.89, "UI", kGain, "rate_hmean",
     "vdcp", "red"},
    {"vdcp-over-red-2d", kConclusion, "gain of VDCP over RED", kShare, 0.50, "2D", kGain, "rate_hmean",
     "vdcp", "red"},
    {"hdcp-over-ras-ui", kConclusion, "gain of HDCP over RAS", kShare, 1.63, "UI", kGain, "rate_hmean",
     "hdcp", "ras", kRasRules},
    {"hdcp-over-ras-2d", kConclusion, "gain of HDCP over RAS", kShare, 0.79, "2D", kGain, "rate_hmean",
     "hdcp", "ras", kRasRules},
    {"hdcp-over-ras-3d", kConclusion, "gain of HDCP over RAS", kShare, 0.27, "3D", kGain, "rate_hmean",
     "hdcp", "ras", kRasRules},
    {"hdcp-over-red-ui", kConclusion, "gain of HDCP over RED", kShare, 1.59, "UI", kGain, "rate_hmean",
     "hdcp", "red"},
    {"hdcp-over-red-2d", kConclusion, "gain of HDCP over RED", kShare, 1.69, "2D", kGain, "rate_hmean",
     "hdcp", "red"},
    {"hdcp-over-red-3d", kConclusion, "gain of HDCP over RED", kShare, 1.39, "3D", kGain, "rate_hmean",
     "hdcp", "red"},
};

}  // namespace

std::span<const ClaimRule> claim_rules() {
  return kRules;
}

}  // namespace tilepress
