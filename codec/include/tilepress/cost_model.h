// Cost model: energy, power, storage, area and speed of the DCP structures (paper §Implementation
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

/// The constants of the model. The defaults are the paper's.
struct CostConstants {
  double dram_pj_per_byte = 451.2;       ///< LPDDR3, dynamic; per byte moved
  double structures_pj_per_byte = 4.83;  ///< DCP's structures, static and dynamic; per raw byte
  uint32_t table_entries = 64;           ///< entries that the figures below hold for
  StructureFigures fvc{0.00304232, 0.881899, 0.766572, 0.131695, 7241};
  StructureFigures ccd{0.00197988, 0.39, 0.402, 0.128338, 7431};
  StructureFigures rccd{0.000281592, 0.281112, 0.104106, 0.0722227, 13203};
};

/// Returns the share of DRAM energy saved at a rate (raw / moved bits, > 0): 1 − 1/rate − structures/DRAM.
/// The share is negative if compression costs more than it saves. The paper states the structures' energy for
/// DCP only.
double energy_saving(double rate, const CostConstants& constants = {});

/// The traffic of a surface that is written and read in every refresh.
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
/// Returns the power of DRAM and structures if `raw_bytes_per_s` shrink by `rate`, in mW.
double compressed_power_mw(double raw_bytes_per_s, double rate, const CostConstants& constants = {});

/// Returns the bits of an FVC: per entry a colour, a valid bit and a counter of ceil(log2(frame pixels))
/// bits.
uint64_t fvc_storage_bits(uint32_t entries, uint32_t pixel_bits, uint64_t frame_pixels);
/// Returns the bits of a CCD or of one rCCD: per entry a colour and a valid bit.
uint64_t ccd_storage_bits(uint32_t entries, uint32_t pixel_bits);

/// Returns the area of one FVC, one CCD and one rCCD per surface that is read at once, in mm². Sizes other
/// than 64 entries are scaled by entries / 64: an estimate, not a CACTI run.
double structures_area_mm2(uint32_t entries, uint32_t surfaces, const CostConstants& constants = {});

/// Whether the structures keep up: million pixels per second needed, against CACTI's bandwidth for 64
/// entries.
struct BandwidthCheck {
  double fvc_needed, ccd_needed, rccd_needed;
  bool fvc_suffices, ccd_suffices, rccd_suffices;
  bool suffices() const { return fvc_suffices && ccd_suffices && rccd_suffices; }
};
/// The CCD looks up every pixel written, the FVC takes every sample-th, and the rCCD of a surface restores
/// every pixel read.
BandwidthCheck check_bandwidth(const SurfaceLoad& load, uint32_t sample, const CostConstants& constants = {});

}  // namespace tilepress
