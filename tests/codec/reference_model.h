// Reference model: the rules of the codec written once more, slowly, to compare the engine with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/scheme_spec.h"

/// Shares no code with codec/: only the vocabulary (SchemeSpec, PixelFormat) is the same. Every rule is a
/// plain loop over pixels; nothing is kept that could be computed again. RGB565 and RGB10A2 follow the same
/// rules with their own channel and pixel widths.
namespace reference {

using tilepress::PixelFormat;
using tilepress::SchemeSpec;

/// The value of a key that holds a number or a choice; `fallback` if the scheme has no such key.
inline uint32_t number_of(const SchemeSpec& spec, std::string_view key, uint32_t fallback) {
  for (const auto& [name, value] : spec.values)
    if (name == key) return std::get<uint32_t>(value);
  return fallback;
}

/// Pixel words in raster order, row 0 on top.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> words;
  uint32_t at(uint32_t x, uint32_t y) const { return words[size_t{y} * width + x]; }
  /// Pixels outside the surface repeat the nearest one inside.
  uint32_t padded(uint32_t x, uint32_t y) const {
    return at(x < width ? x : width - 1, y < height ? y : height - 1);
  }
};

/// A pixel of the traversal.
struct Place {
  uint32_t x, y;
  bool inside;
};

/// What one scheme makes of one frame.
struct Figures {
  uint64_t payload_bits = 0, bursts = 0, csb_bits = 0, palette_bits = 0, extra_bits = 0;
  bool operator==(const Figures&) const = default;
};

struct Metrics {
  uint64_t unique_colors = 0;
  double entropy = 0, pixel_change = 0, color_change = 0;
  double fvc_coverage = 0, fvc_relative_coverage = 0, top100_coverage = 0;
};

struct Slot {
  bool valid = false;
  uint32_t color = 0;
  uint64_t count = 0;
  uint64_t used = 0;  ///< when it was last hit or inserted
};

/// What an FVC holds after a frame.
struct Collection {
  std::vector<Slot> slots;
  uint64_t samples = 0;
};

/// The dictionary made of it: valid entries, most frequent first.
struct Dictionary {
  bool exists = false;
  uint32_t entries = 0;  ///< N
  std::vector<Slot> slots;
  uint64_t samples = 0;
  double coverage = 0;
};

/// One scheme on one surface.
class Scheme {
 public:
  Scheme(SchemeSpec spec, PixelFormat format, uint32_t tile_side, uint32_t burst_bits)
      : spec_(std::move(spec)), format_(format), tile_side_(tile_side), burst_bits_(burst_bits) {}
  Figures frame(const Picture& picture);

 private:
  uint32_t block_bits(const std::vector<uint32_t>& block) const;
  uint32_t vdcp_bits(const std::vector<uint32_t>& block) const;
  uint32_t ras_bits(const std::vector<uint32_t>& block) const;
  uint32_t escaped_bits(const std::vector<uint32_t>& block) const;
  uint32_t dictionary_bits(const std::vector<uint32_t>& block) const;
  /// palette, fbc, te, bdi, bpc, fpc, fpcd, cpack, hilo, msaa, and the formats of hardware.
  Figures further_frame(const Picture& picture);
  SchemeSpec spec_;
  PixelFormat format_;
  uint32_t tile_side_, burst_bits_;
  uint64_t frame_number_ = 0;
  Dictionary dictionary_;
  uint32_t width_ = 0;                  ///< of an index, dcp and adcp
  std::vector<uint32_t> code_lengths_;  ///< huffdcp, freqvals
  bool off_ = false;                    ///< by the coverage threshold
  Picture before_;                      ///< te
};

/// The frame metrics of a surface.
class Meter {
 public:
  Meter(PixelFormat format, uint32_t tile_side) : format_(format), tile_side_(tile_side) {}
  Metrics frame(const Picture& picture);

 private:
  PixelFormat format_;
  uint32_t tile_side_;
  bool first_ = true;
  Picture before_;
};

std::vector<Place> traversal(uint32_t width, uint32_t height, uint32_t tile_side);
Collection collect(const SchemeSpec& spec, PixelFormat format, const Picture& picture, uint32_t tile_side);
std::vector<uint32_t> huffman_lengths(const std::vector<uint64_t>& counts);
/// RAS stream of a block of 64 words in raster order, not rounded.
uint32_t ras_stream(const std::vector<uint32_t>& block, PixelFormat format, bool ycocg);

/// Bits of a block of 64 words in raster order.
uint32_t bdi_bits(const std::vector<uint32_t>& block, PixelFormat format, bool quads);
uint32_t bpc_bits(const std::vector<uint32_t>& block, PixelFormat format, bool quads);
/// `scheme`: fpc, fpcd or cpack.
uint32_t word_line_bits(const std::string& scheme, const std::vector<uint32_t>& block, bool quads);
uint32_t hilo_bits(const std::vector<uint32_t>& block);
uint32_t msaa_bits(const std::vector<uint32_t>& block);
/// intel8, intel11, amddcc.
bool is_of_hardware(const std::string& scheme);
uint32_t hardware_bits(const std::vector<uint32_t>& block, const std::string& scheme);
uint32_t hardware_csb_bits(const std::string& scheme);

}  // namespace reference
