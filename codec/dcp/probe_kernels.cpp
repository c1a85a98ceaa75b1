// Probe kernels, plainly: the definition.
#include "dcp/probe_kernels.h"

#include <algorithm>
#include <bit>

#include "dcp/index_widths.h"

namespace tilepress {
namespace {

void find(const uint32_t* pixels, const ProbeTable& table, uint16_t* indices, uint8_t* widths) {
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t at = table.bucket(pixels[i]);
    indices[i] = table.colors[at] == pixels[i] ? static_cast<uint16_t>(table.values[at]) : kNotInCcd;
  }
  fill_widths(indices, widths);
}

void find_few(const uint32_t*, const FewColors& few, const uint32_t* few_values, uint16_t* indices,
              uint8_t* widths) {
  for (uint32_t n = 0; n < few.count; ++n)
    for (uint32_t i = 0; i < kBlockPixels; ++i)
      if ((few.places[n] >> i & 1) != 0) indices[i] = static_cast<uint16_t>(few_values[n]);
  fill_widths(indices, widths);
}

uint64_t members(const uint32_t* pixels, const ProbeTable& table, const uint32_t* crowded_colors,
                 uint32_t crowded, uint32_t* places) {
  uint64_t mask = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t bucket = table.bucket(pixels[i]);
    places[i] = table.colors[bucket] == pixels[i] ? bucket : table.size();
    for (uint32_t c = 0; c < crowded; ++c)
      if (pixels[i] == crowded_colors[c]) places[i] = table.size() + 1 + c;
    mask |= uint64_t{places[i] != table.size()} << i;
  }
  return mask;
}

Smallest find_smallest(const uint32_t* counts, uint32_t stride) {
  Smallest found = {0, ~0u, ~0u};
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    uint32_t count = 0;
    for (uint32_t n = 0; n < 4; ++n) count += counts[i + n * stride];
    if (count < found.smallest)
      found = {i, count, found.smallest};
    else
      found.second = std::min(found.second, count);
  }
  return found;
}

}  // namespace

uint64_t compact_plainly(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out) {
  uint64_t alike = 0;
  for (uint32_t count = 0; mask != 0; mask &= mask - 1, ++count) {
    out[count] = pixels[std::countr_zero(mask)];
    alike |= uint64_t{out[count] == before} << count;
    before = out[count];
  }
  return alike;
}

constexpr ProbeKernels kPlainProbeKernels = {.find = find,
                                             .find_few = find_few,
                                             .members = members,
                                             .find_smallest = find_smallest,
                                             .compact = compact_plainly};

}  // namespace tilepress
