// Reference model: the schemes of the paper, RAS and RED.
#include <algorithm>
#include <array>

#include "reference_model.h"

namespace reference {
namespace {

uint32_t pixel_bits(PixelFormat format) {
  return format == PixelFormat::kRgb565 ? 16 : 32;
}

uint32_t rounded_up_log2(uint32_t value) {
  uint32_t bits = 0;
  while ((uint64_t{1} << bits) < value) ++bits;
  return bits;
}

/// The four raster positions of sub-block `sub`.
std::array<uint32_t, 4> sub_block(uint32_t sub) {
  const uint32_t top_left = sub / 4 * 16 + sub % 4 * 2;
  return {top_left, top_left + 1, top_left + 8, top_left + 9};
}

constexpr uint32_t kAbsent = 1u << 30;

uint32_t index_of(const Dictionary& dictionary, uint32_t color) {
  for (uint32_t i = 0; i < dictionary.slots.size(); ++i)
    if (dictionary.slots[i].color == color) return i;
  return kAbsent;
}

uint32_t largest_index(const Dictionary& dictionary, const std::vector<uint32_t>& block, uint32_t sub) {
  uint32_t largest = 0;
  for (const uint32_t position : sub_block(sub))
    largest = std::max(largest, index_of(dictionary, block[position]));
  return largest;
}

uint32_t algorithm1(const Dictionary& dictionary, uint32_t bits) {
  uint64_t expected = dictionary.samples * bits;
  uint32_t best = 0;
  for (uint32_t i = 0; (1u << i) <= dictionary.entries; ++i) {
    uint64_t sum = 0;
    for (uint32_t entry = 0; entry < (1u << i) && entry < dictionary.slots.size(); ++entry)
      sum += dictionary.slots[entry].count;
    const uint64_t size = sum * i + (dictionary.samples - sum) * bits;
    if (size < expected) {
      expected = size;
      best = i;
    }
  }
  return best;
}

uint32_t red_bits(const std::vector<uint32_t>& block, uint32_t bits) {
  const auto uniform = [&](uint32_t region_width) {
    for (uint32_t y = 0; y < 8; ++y)
      for (uint32_t x = 0; x < 8; ++x)
        if (block[8 * y + x] != block[8 * (y / 2 * 2) + x / region_width * region_width]) return false;
    return true;
  };
  if (uniform(4)) return 8 * bits;
  if (uniform(2)) return 16 * bits;
  return 64 * bits;
}

/// Planes in order, and the width of each plane's first pixel.
void split(const std::vector<uint32_t>& block, PixelFormat format, bool ycocg,
           std::vector<std::vector<int>>& planes, std::vector<uint32_t>& widths) {
  planes.assign(format == PixelFormat::kRgb565 ? 3 : 4, std::vector<int>(64));
  for (uint32_t i = 0; i < 64; ++i) {
    const uint32_t word = block[i];
    if (format == PixelFormat::kRgb565) {
      planes[0][i] = word >> 11 & 31;
      planes[1][i] = word >> 5 & 63;
      planes[2][i] = word & 31;
      widths = {5, 6, 5};
    } else if (format == PixelFormat::kRgb10a2) {
      for (uint32_t c = 0; c < 3; ++c) planes[c][i] = word >> (10 * c) & 1023;
      planes[3][i] = word >> 30;
      widths = {10, 10, 10, 2};
    } else {
      for (uint32_t c = 0; c < 4; ++c) planes[c][i] = word >> (8 * c) & 255;
      widths = {8, 8, 8, 8};
    }
    if (!ycocg) continue;
    const int r = planes[0][i], g = planes[1][i], b = planes[2][i];
    const int co = r - b, t = b + (co >> 1), cg = g - t, y = t + (cg >> 1);
    planes[0][i] = y;
    planes[1][i] = co;
    planes[2][i] = cg;
  }
  if (!ycocg) return;
  const uint32_t widest = std::max({widths[0], widths[1], widths[2]});
  widths[0] = widest;
  widths[1] = widths[2] = widest + 1;
}

int predicted(const std::vector<int>& plane, uint32_t x, uint32_t y) {
  if (y == 0) return plane[x - 1];
  if (x == 0) return plane[8 * (y - 1)];
  const int a = plane[8 * y + x - 1], b = plane[8 * (y - 1) + x], c = plane[8 * (y - 1) + x - 1];
  if (c >= std::max(a, b)) return std::min(a, b);
  if (c <= std::min(a, b)) return std::max(a, b);
  return a + b - c;
}

}  // namespace

std::vector<uint32_t> huffman_lengths(const std::vector<uint64_t>& counts) {
  struct Node {
    uint64_t count;
    bool joined;
    std::vector<size_t> leaves;
  };
  std::vector<Node> nodes;
  for (size_t i = 0; i < counts.size(); ++i) nodes.push_back({counts[i], false, {i}});
  std::vector<uint32_t> lengths(counts.size(), counts.size() == 1 ? 1 : 0);
  for (size_t join = 1; join < counts.size(); ++join) {
    size_t pair[2];
    for (size_t& chosen : pair) {
      chosen = nodes.size();
      for (size_t id = 0; id < nodes.size(); ++id)
        if (!nodes[id].joined && (chosen == nodes.size() || nodes[id].count < nodes[chosen].count))
          chosen = id;
      nodes[chosen].joined = true;
    }
    Node parent{nodes[pair[0]].count + nodes[pair[1]].count, false, nodes[pair[0]].leaves};
    for (const size_t leaf : nodes[pair[1]].leaves) parent.leaves.push_back(leaf);
    for (const size_t leaf : parent.leaves) ++lengths[leaf];
    nodes.push_back(parent);
  }
  return lengths;
}

uint32_t ras_stream(const std::vector<uint32_t>& block, PixelFormat format, bool ycocg) {
  std::vector<std::vector<int>> planes;
  std::vector<uint32_t> widths;
  split(block, format, ycocg, planes, widths);
  uint32_t bits = 0;
  for (size_t p = 0; p < planes.size(); ++p) {
    bits += widths[p];
    for (uint32_t group = 0; group < 16; ++group) {
      std::vector<uint32_t> folded;
      for (const uint32_t position : sub_block(group)) {
        if (position == 0) continue;
        const int e = planes[p][position] - predicted(planes[p], position % 8, position / 8);
        folded.push_back(static_cast<uint32_t>(e >= 0 ? 2 * e : -2 * e - 1));
      }
      bits += 3;
      if (std::all_of(folded.begin(), folded.end(), [](uint32_t u) { return u == 0; })) continue;
      uint32_t least = ~0u;
      for (uint32_t k = 0; k <= 6; ++k) {
        uint32_t cost = 0;
        for (const uint32_t u : folded) cost += u / (1u << k) + 1 + k;
        least = std::min(least, cost);
      }
      bits += least;
    }
  }
  return bits;
}

uint32_t Scheme::ras_bits(const std::vector<uint32_t>& block) const {
  const uint32_t raw = 64 * pixel_bits(format_),
                 stream = ras_stream(block, format_, number_of(spec_, "ycocg", 0) == 1);
  if (spec_.name == "ras" && number_of(spec_, "sizes", 0) == 2)
    return std::min(raw, (stream + burst_bits_ - 1) / burst_bits_ * burst_bits_);
  if (stream <= raw / 4) return raw / 4;
  if (stream <= raw / 2) return raw / 2;
  if (stream <= raw / 4 * 3 && number_of(spec_, "sizes", 0) != 1) return raw / 4 * 3;
  return raw;
}

uint32_t Scheme::vdcp_bits(const std::vector<uint32_t>& block) const {
  uint32_t bits = 0;
  for (uint32_t sub = 0; sub < 16; ++sub) {
    const uint32_t largest = dictionary_.exists ? largest_index(dictionary_, block, sub) : kAbsent;
    bits += 4 * (largest == kAbsent ? pixel_bits(format_) : rounded_up_log2(largest + 1));
  }
  return bits;
}

/// A code for each pixel; the last code is the escape of the colours that have none.
uint32_t Scheme::escaped_bits(const std::vector<uint32_t>& block) const {
  uint32_t bits = 0;
  for (const uint32_t color : block) {
    const uint32_t index = index_of(dictionary_, color);
    bits += index == kAbsent ? code_lengths_.back() + 32 : code_lengths_[index];
  }
  return std::min(bits, 2048u);
}

uint32_t Scheme::block_bits(const std::vector<uint32_t>& block) const {
  const uint32_t raw_sub_block = 4 * pixel_bits(format_);
  if (spec_.name == "red") return red_bits(block, pixel_bits(format_));
  if (spec_.name == "ras") return ras_bits(block);
  if (spec_.name == "hdcp") {
    const uint32_t vdcp = vdcp_bits(block), ras = ras_bits(block);
    const auto bursts = [&](uint32_t bits) { return (bits + burst_bits_ - 1) / burst_bits_; };
    return off_ || bursts(ras) < bursts(vdcp) ? ras : vdcp;
  }
  if (off_ || !dictionary_.exists) return 16 * raw_sub_block;
  if (spec_.name == "vdcp") return vdcp_bits(block);
  if (spec_.name == "freqvals") return escaped_bits(block);
  uint32_t bits = 0;
  for (uint32_t sub = 0; sub < 16; ++sub) {
    const uint32_t largest = largest_index(dictionary_, block, sub);
    if (spec_.name == "huffdcp") {
      uint32_t sum = largest == kAbsent ? raw_sub_block : 0;
      if (largest != kAbsent)
        for (const uint32_t position : sub_block(sub))
          sum += code_lengths_[index_of(dictionary_, block[position])];
      bits += std::min(sum, raw_sub_block);
    } else {
      bits += largest < 1u << width_ ? 4 * width_ : raw_sub_block;
    }
  }
  return bits;
}

Figures Scheme::frame(const Picture& picture) {
  for (const char* name : {"palette", "fbc", "te", "bdi", "bpc", "fpc", "fpcd", "cpack", "hilo", "msaa"})
    if (spec_.name == name) return further_frame(picture);
  if (is_of_hardware(spec_.name)) return further_frame(picture);
  const uint32_t bits = pixel_bits(format_), m = rounded_up_log2(number_of(spec_, "fvc", 64));
  const bool palette = spec_.name != "red" && spec_.name != "ras";
  const bool escapes = spec_.name == "freqvals";
  off_ = palette && !escapes && dictionary_.exists && dictionary_.coverage < spec_.share("coverage");
  width_ = m;
  if (spec_.name == "adcp" && dictionary_.exists) width_ = algorithm1(dictionary_, bits);
  std::vector<uint64_t> counts;
  for (const Slot& slot : dictionary_.slots) counts.push_back(slot.count);
  if (escapes) {
    uint64_t others = dictionary_.samples;
    for (const uint64_t count : counts) others -= count;
    counts.push_back(others);
  }
  code_lengths_ = huffman_lengths(counts);

  Figures figures;
  uint64_t blocks = 0;
  std::vector<uint32_t> block(64);
  for (uint32_t y = 0; y < picture.height; y += 8)
    for (uint32_t x = 0; x < picture.width; x += 8) {
      for (uint32_t i = 0; i < 64; ++i) block[i] = picture.padded(x + i % 8, y + i / 8);
      const uint32_t payload = block_bits(block);
      figures.payload_bits += payload;
      figures.bursts += payload / burst_bits_ + (payload % burst_bits_ != 0);
      ++blocks;
    }
  uint32_t csb = 0;
  if (spec_.name == "red") csb = 2;
  if (spec_.name == "ras" || escapes)
    csb = escapes || number_of(spec_, "sizes", 0) == 2
              ? rounded_up_log2((64 * bits + burst_bits_ - 1) / burst_bits_ + 1)
              : 2;
  if (spec_.name == "dcp" || spec_.name == "adcp" || spec_.name == "huffdcp") csb = off_ ? 0 : 16;
  if (spec_.name == "vdcp") csb = off_ ? 0 : 16 * rounded_up_log2(m + 2);
  if (spec_.name == "hdcp") csb = off_ ? 2 : 16 * 5;
  figures.csb_bits = blocks * csb;
  if (palette && dictionary_.exists && !off_) {
    const uint64_t slots = spec_.name == "adcp" ? uint64_t{1} << width_ : dictionary_.entries;
    figures.palette_bits =
        slots * (bits + 1 + (spec_.name == "huffdcp" || escapes ? 6 : 0)) + (escapes ? 6 : 0);
  }

  if (palette && frame_number_ % number_of(spec_, "period", 1) == 0) {
    const Collection collection = collect(spec_, format_, picture, tile_side_);
    dictionary_ = {true, number_of(spec_, "fvc", 64), {}, collection.samples, 0};
    uint64_t held = 0;
    for (const Slot& slot : collection.slots)
      if (slot.valid) {
        dictionary_.slots.push_back(slot);
        held += slot.count;
      }
    std::stable_sort(dictionary_.slots.begin(), dictionary_.slots.end(),
                     [](const Slot& a, const Slot& b) { return a.count > b.count; });
    dictionary_.coverage = double(held) / collection.samples;
  }
  ++frame_number_;
  return figures;
}

}  // namespace reference
