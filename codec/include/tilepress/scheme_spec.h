// Scheme specifications: `name:key=value,key=value`, parsed and checked against the registry.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// FVC replacement policy (paper §Factors affecting FVC Fidelity; spec §3).
enum class FvcPolicy : uint8_t { kLfc, k2Lfc, kLru, kRandom };

/// Everything that decides what an FVC collects. Schemes with equal configurations share one FVC and one CCD.
struct FvcConfig {
  uint32_t entries = 64;  ///< a power of two, 2..1024
  FvcPolicy policy = FvcPolicy::kLfc;
  uint32_t ways = 0;    ///< divides entries; 0 = fully associative
  uint32_t sample = 1;  ///< every sample-th pixel enters the FVC, ≥ 1
  uint32_t period = 1;  ///< the FVC collects in every period-th frame, ≥ 1
  bool operator==(const FvcConfig&) const = default;
  uint32_t ways_per_set() const { return ways == 0 ? entries : ways; }
};

enum class RasSizes : uint8_t { kThree, kTwo, kBurst };

/// Order in which a block's pixels fill memory lines.
enum class LineOrder : uint8_t { kRaster, kQuad };

/// A scheme with its options. `text` is the specification as the user wrote it and names the scheme in every
/// output.
struct SchemeSpec {
  std::string text;
  std::string name;  ///< the part before ':', a name of the registry
  FvcConfig fvc;
  double coverage = 0;  ///< DCP is off for frames whose CCD came from an FVC with a lower coverage; 0..1
  bool ycocg = false;
  RasSizes ras_sizes = RasSizes::kThree;
  uint32_t entries = 64;                 ///< palette, fbc: slots of the dictionary, a power of two, 2..1024
  std::vector<uint32_t> palette;         ///< of palette:file=…, RGBA8 words; empty = from the first frame
  LineOrder order = LineOrder::kRaster;  ///< bdi, bpc
};

/// What palette:file=PATH does: read the colours, or take the path as it is. Who only decodes needs no
/// colours, since a frame's tables hold them, and should open no file that somebody else named.
enum class PaletteFiles : uint8_t { kRead, kLeave };

/// Parses one specification. On failure returns nothing and sets `error` to one line that names the fault.
std::optional<SchemeSpec> parse_scheme(std::string_view text, std::string& error,
                                       PaletteFiles files = PaletteFiles::kRead);

/// The seven schemes of the paper, in the order of spec §12.
std::vector<SchemeSpec> default_schemes();

}  // namespace tilepress
