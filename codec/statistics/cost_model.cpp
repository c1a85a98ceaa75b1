// Cost model: arithmetic on the paper's figures.
#include "tilepress/cost_model.h"

#include <bit>

namespace tilepress {
namespace {
constexpr double kMilliwattsPerPicojoulePerSecond = 1e-9;
}

double energy_saving(double rate, const CostConstants& constants) {
  return 1 - 1 / rate - constants.structures_pj_per_byte / constants.dram_pj_per_byte;
}

double dram_power_mw(double bytes_per_s, const CostConstants& constants) {
  return bytes_per_s * constants.dram_pj_per_byte * kMilliwattsPerPicojoulePerSecond;
}

double compressed_power_mw(double raw_bytes_per_s, double rate, const CostConstants& constants) {
  return dram_power_mw(raw_bytes_per_s, constants) * (1 - energy_saving(rate, constants));
}

uint64_t fvc_storage_bits(uint32_t entries, uint32_t pixel_bits, uint64_t frame_pixels) {
  const auto counter_bits = frame_pixels < 2 ? 0u : static_cast<uint32_t>(std::bit_width(frame_pixels - 1));
  return uint64_t{entries} * (pixel_bits + 1 + counter_bits);
}

uint64_t ccd_storage_bits(uint32_t entries, uint32_t pixel_bits) {
  return uint64_t{entries} * (pixel_bits + 1);
}

double structures_area_mm2(uint32_t entries, uint32_t surfaces, const CostConstants& constants) {
  const double scale = static_cast<double>(entries) / constants.table_entries;
  return scale * (constants.fvc.area_mm2 + constants.ccd.area_mm2 + surfaces * constants.rccd.area_mm2);
}

BandwidthCheck check_bandwidth(const SurfaceLoad& load, uint32_t sample, const CostConstants& constants) {
  const double mpixels = load.pixels_per_s() / 1e6;
  BandwidthCheck check{};
  check.fvc_needed = mpixels / sample;
  check.ccd_needed = mpixels;
  check.rccd_needed = mpixels;
  check.fvc_suffices = check.fvc_needed <= constants.fvc.mpixels_per_s;
  check.ccd_suffices = check.ccd_needed <= constants.ccd.mpixels_per_s;
  check.rccd_suffices = check.rccd_needed <= constants.rccd.mpixels_per_s;
  return check;
}

}  // namespace tilepress
