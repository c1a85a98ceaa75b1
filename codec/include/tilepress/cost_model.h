// Cost model: energy, power, storage, area and speed of the DCP structures (spec §9; paper §Implementation
// Cost and Energy Savings).
#pragma once

#include <cstdint>

namespace tilepress {

/// One line of the paper's table of CACTI 7.0 figures: 22 nm, 64 entries.
struct StructureFigures {
  double area_mm2;
  double leakage_mw;
  double access_pj;
  double latency_ns;
  double mpixels_per_s;  ///< largest bandwidth, million pixels a second
};

/// What the model rests on. The defaults are the paper's.
struct CostConstants {
  double dram_pj_per_byte = 451.2;       ///< LPDDR3, dynamic; per byte moved
  double structures_pj_per_byte = 4.83;  ///< DCP's structures, static and dynamic; per raw byte
  uint32_t table_entries = 64;           ///< entries that the figures below hold for
  StructureFigures fvc{0.00304232, 0.881899, 0.766572, 0.131695, 7241};
  StructureFigures ccd{0.00197988, 0.39, 0.402, 0.128338, 7431};
  StructureFigures rccd{0.000281592, 0.281112, 0.104106, 0.0722227, 13203};
};

/// Share of the DRAM energy saved at a rate (raw / moved bits, > 0): 1 − 1/rate − structures/DRAM. Negative
/// where compression costs more than it saves. The paper names the structures' energy for DCP only; for other
/// schemes it stands in for logic that nobody has measured.
double energy_saving(double rate, const CostConstants& constants = {});

/// A surface that is written and read again and again.
struct SurfaceLoad {
  uint32_t width = 1920, height = 1080;
  uint32_t pixel_bits = 32;
  double refresh_hz = 60;
  double passes = 2;  ///< times a pixel moves in a refresh: written by the GPU, read by the display

  double pixels_per_s() const { return double(width) * height * refresh_hz; }
  double raw_bytes_per_s() const { return pixels_per_s() * passes * pixel_bits / 8; }
};

/// Returns the dynamic DRAM power of moving `bytes_per_s`, in mW. The paper's 199.6 mW is the power of its own
/// display: 720×1280 RGBA8, written and read 60 times a second, 442.37 MB/s.
double dram_power_mw(double bytes_per_s, const CostConstants& constants = {});
/// Power of DRAM and structures when `raw_bytes_per_s` shrink by `rate`, mW.
double compressed_power_mw(double raw_bytes_per_s, double rate, const CostConstants& constants = {});

/// Storage of an FVC, bits: a colour, a valid bit and a counter of ceil(log2(frame pixels)) bits an entry.
uint64_t fvc_storage_bits(uint32_t entries, uint32_t pixel_bits, uint64_t frame_pixels);
/// Storage of a CCD or of one rCCD, bits: a colour and a valid bit an entry.
uint64_t ccd_storage_bits(uint32_t entries, uint32_t pixel_bits);

/// Area of one FVC, one CCD and an rCCD for each surface read at once, mm². For other than 64 entries a
/// linear extrapolation, entries / 64: an estimate, no CACTI run.
double structures_area_mm2(uint32_t entries, uint32_t surfaces, const CostConstants& constants = {});

/// Can the structures keep up? Million pixels a second, needed beside what CACTI gives for 64 entries.
struct BandwidthCheck {
  double fvc_needed, ccd_needed, rccd_needed;
  bool fvc_suffices, ccd_suffices, rccd_suffices;
  bool suffices() const { return fvc_suffices && ccd_suffices && rccd_suffices; }
};
/// Every pixel written is looked up in the CCD, every sample-th enters the FVC; every pixel read passes the
/// rCCD of its surface.
BandwidthCheck check_bandwidth(const SurfaceLoad& load, uint32_t sample, const CostConstants& constants = {});

}  // namespace tilepress
