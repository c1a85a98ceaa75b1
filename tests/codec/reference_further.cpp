// Reference model: palette, frame buffer compression after rendering, transaction elimination.
#include <algorithm>
#include <map>

#include "reference_model.h"

namespace reference {
namespace {

std::vector<Slot> most_frequent(const Picture& picture, uint32_t limit) {
  std::map<uint32_t, uint64_t> counts;
  for (const uint32_t color : picture.words) ++counts[color];
  std::vector<Slot> slots;
  for (const auto& [color, count] : counts) slots.push_back({true, color, count, 0});
  std::stable_sort(slots.begin(), slots.end(),
                   [](const Slot& a, const Slot& b) { return a.count > b.count; });
  if (slots.size() > limit) slots.resize(limit);
  return slots;
}

}  // namespace

/// Sub-blocks whose four colours are in the dictionary cost their codes, if those are shorter than raw.
uint32_t Scheme::dictionary_bits(const std::vector<uint32_t>& block) const {
  const uint32_t raw = format_ == PixelFormat::kRgb565 ? 64 : 128;
  uint32_t total = 0;
  for (uint32_t sub = 0; sub < 16; ++sub) {
    uint32_t bits = 0;
    for (uint32_t pixel = 0; pixel < 4; ++pixel) {
      const uint32_t color = block[(sub / 4 * 2 + pixel / 2) * 8 + sub % 4 * 2 + pixel % 2];
      uint32_t code = raw;
      for (uint32_t i = 0; i < dictionary_.slots.size(); ++i)
        if (dictionary_.slots[i].color == color) code = code_lengths_[i];
      bits += code;
    }
    total += std::min(bits, raw);
  }
  return total;
}

Figures Scheme::further_frame(const Picture& picture) {
  const uint32_t pixel = format_ == PixelFormat::kRgb565 ? 16 : 32, raw = 64 * pixel;
  const uint64_t raw_bursts = (raw + burst_bits_ - 1) / burst_bits_;
  Figures figures;
  code_lengths_.clear();
  if (spec_.name == "fbc") {
    dictionary_.slots = most_frequent(picture, number_of(spec_, "entries", 64));
    std::vector<uint64_t> counts;
    for (const Slot& slot : dictionary_.slots) counts.push_back(slot.count);
    code_lengths_ = huffman_lengths(counts);
    figures.palette_bits = uint64_t{number_of(spec_, "entries", 64)} * (pixel + 1 + 6);
  }
  if (spec_.name == "palette" && frame_number_ > 0) {
    uint32_t width = 0;
    while (1u << width < number_of(spec_, "entries", 64)) ++width;
    code_lengths_.assign(dictionary_.slots.size(), width);
    figures.palette_bits = uint64_t{number_of(spec_, "entries", 64)} * (pixel + 1);
  }
  std::vector<uint32_t> block(64);
  uint64_t blocks = 0, tiles = 0;
  for (uint32_t y = 0; y < picture.height; y += 8)
    for (uint32_t x = 0; x < picture.width; x += 8) {
      for (uint32_t i = 0; i < 64; ++i) block[i] = picture.padded(x + i % 8, y + i / 8);
      ++blocks;
      if (x % 16 == 0 && y % 16 == 0) ++tiles;
      uint32_t payload = raw;
      if (spec_.name == "bdi") payload = bdi_bits(block, format_, number_of(spec_, "order", 0) == 1);
      if (spec_.name == "bpc") payload = bpc_bits(block, format_, number_of(spec_, "order", 0) == 1);
      if (spec_.name == "fpc" || spec_.name == "fpcd" || spec_.name == "cpack")
        payload = word_line_bits(spec_.name, block, number_of(spec_, "order", 0) == 1);
      if (spec_.name == "hilo") payload = hilo_bits(block);
      if (spec_.name == "msaa") payload = msaa_bits(block);
      if (is_of_hardware(spec_.name)) payload = hardware_bits(block, spec_.name);
      if (spec_.name == "fbc" || (spec_.name == "palette" && frame_number_ > 0))
        payload = dictionary_bits(block);
      if (spec_.name == "te" && frame_number_ > 0) {
        bool changed = false;
        for (uint32_t ty = y / 16 * 16; ty < y / 16 * 16 + 16; ++ty)
          for (uint32_t tx = x / 16 * 16; tx < x / 16 * 16 + 16; ++tx)
            changed |= picture.padded(tx, ty) != before_.padded(tx, ty);
        if (!changed) payload = 0;
      }
      figures.payload_bits += payload;
      figures.bursts += (payload + burst_bits_ - 1) / burst_bits_;
    }
  if (spec_.name == "palette" || spec_.name == "fbc") figures.csb_bits = blocks * 16;
  if (spec_.name == "te") figures.csb_bits = blocks;
  if (spec_.name == "bdi") figures.csb_bits = blocks * (raw / 512) * 4;
  if (spec_.name == "bpc") figures.csb_bits = blocks * (raw / 1024) * 7;
  if (spec_.name == "fpc" || spec_.name == "fpcd" || spec_.name == "cpack") figures.csb_bits = blocks * 4 * 7;
  if (spec_.name == "hilo") figures.csb_bits = blocks * 2;
  if (spec_.name == "msaa") figures.csb_bits = blocks * 3;
  if (is_of_hardware(spec_.name)) figures.csb_bits = blocks * hardware_csb_bits(spec_.name);
  if (spec_.name == "fbc") figures.extra_bits = blocks * 3 * raw_bursts * burst_bits_;
  if (spec_.name == "te") {
    figures.palette_bits = tiles * 64;
    figures.extra_bits = frame_number_ > 0 ? tiles * 64 : 0;
    before_ = picture;
  }
  if (spec_.name == "palette" && frame_number_ == 0)
    dictionary_.slots = most_frequent(picture, number_of(spec_, "entries", 64));
  ++frame_number_;
  return figures;
}

}  // namespace reference
