// Reference model: frequent patterns and C-Pack, word by word, on the bytes of a block's memory lines.
#include <algorithm>
#include <array>

#include "reference_model.h"

namespace reference {
namespace {

/// A word's bytes, the highest first.
using Bytes = std::array<uint32_t, 4>;

Bytes bytes_of(uint32_t word) {
  return {word >> 24, word >> 16 & 255, word >> 8 & 255, word & 255};
}

bool within(int64_t value, int64_t limit) {
  return value >= -limit && value < limit;
}

uint32_t fpc_word(uint32_t word) {
  const Bytes b = bytes_of(word);
  const int64_t value = static_cast<int32_t>(word);
  const int64_t high = static_cast<int16_t>(word >> 16), low = static_cast<int16_t>(word & 0xFFFF);
  if (within(value, 8)) return 3 + 4;
  if (within(value, 128) || (b[0] == b[1] && b[1] == b[2] && b[2] == b[3])) return 3 + 8;
  if (within(value, 32768) || low == 0 || (within(high, 128) && within(low, 128))) return 3 + 16;
  return 3 + 32;
}

uint32_t fpc_line(const std::vector<uint32_t>& words) {
  uint32_t bits = 0;
  for (size_t i = 0; i < 16;) {
    size_t zeros = 0;
    while (zeros < 8 && i + zeros < 16 && words[i + zeros] == 0) ++zeros;
    bits += zeros > 0 ? 6 : fpc_word(words[i]);
    i += std::max<size_t>(zeros, 1);
  }
  return bits;
}

/// The least bytes stored: letters as in the paper, with a word to match for M.
uint32_t fpcd_word(uint32_t word, const std::vector<uint32_t>& before) {
  const Bytes b = bytes_of(word);
  uint32_t least = 4;
  const auto try_form = [&](const char* form, const Bytes& match) {
    uint32_t stored = 0;
    for (size_t i = 0; i < 4; ++i) {
      if (form[i] == 'X') ++stored;
      if ((form[i] == 'Z' && b[i] != 0) || (form[i] == 'F' && b[i] != 255) ||
          (form[i] == 'M' && b[i] != match[i]))
        return;
    }
    least = std::min(least, stored);
  };
  for (const char* form : {"ZZZZ", "FFFF", "ZZZX", "XZZZ", "ZZXX", "ZXZX", "FFXX", "XXZZ"}) try_form(form, b);
  if (b[0] == b[1] && b[1] == b[2] && b[2] == b[3]) least = std::min(least, 1u);
  for (size_t back = 1; back <= 2 && back <= before.size(); ++back)
    for (const char* form : {"MMMM", "MMMX", "MMXX"}) try_form(form, bytes_of(before[before.size() - back]));
  return 4 + 8 * least;
}

uint32_t fpcd_line(const std::vector<uint32_t>& words) {
  uint32_t bits = 0;
  std::vector<uint32_t> before;
  for (const uint32_t word : words) {
    bits += fpcd_word(word, before);
    before.push_back(word);
  }
  return bits;
}

uint32_t cpack_line(const std::vector<uint32_t>& words) {
  uint32_t bits = 0;
  std::vector<uint32_t> dictionary;
  for (const uint32_t word : words) {
    uint32_t matching = 0;  // high bytes
    for (const uint32_t entry : dictionary) {
      uint32_t same = 0;
      while (same < 4 && bytes_of(entry)[same] == bytes_of(word)[same]) ++same;
      matching = std::max(matching, same);
    }
    if (word == 0) {
      bits += 2;
    } else if (matching == 4) {
      bits += 2 + 4;
    } else if (word < 256) {
      bits += 4 + 8;
    } else {
      bits += matching == 3 ? 4 + 4 + 8 : matching == 2 ? 4 + 4 + 16 : 2 + 32;
      dictionary.push_back(word);
    }
  }
  return bits;
}

}  // namespace

uint32_t word_line_bits(const std::string& scheme, const std::vector<uint32_t>& block, bool quads) {
  uint32_t total = 0;
  for (uint32_t line = 0; line < 4; ++line) {
    std::vector<uint32_t> words;
    for (uint32_t i = 16 * line; i < 16 * line + 16; ++i)
      words.push_back(block[quads ? (i / 16 * 2 + i % 4 / 2) * 8 + i / 4 % 4 * 2 + i % 2 : i]);
    const uint32_t bits = scheme == "fpc"    ? fpc_line(words)
                          : scheme == "fpcd" ? fpcd_line(words)
                                             : cpack_line(words);
    const uint32_t bytes = (bits + 7) / 8;
    total += bytes < 64 ? 8 * bytes : 512;
  }
  return total;
}

uint32_t hilo_bits(const std::vector<uint32_t>& block) {
  const uint64_t least = *std::min_element(block.begin(), block.end());
  const uint64_t greatest = *std::max_element(block.begin(), block.end());
  uint32_t size = 512;
  for (const uint64_t step : {uint64_t{1} << 5, uint64_t{1} << 13, uint64_t{1} << 21}) {
    const bool fits = std::all_of(block.begin(), block.end(), [&](uint64_t word) {
      const uint64_t high = word / step;
      return high == least / step || high == greatest / step || high == (least + step) / step ||
             high + 1 == greatest / step;
    });
    if (fits) return size;
    size += 512;
  }
  return 2048;
}

uint32_t msaa_bits(const std::vector<uint32_t>& block) {
  std::vector<uint32_t> pixels;
  for (uint32_t i = 0; i < 64; ++i)
    pixels.push_back(block[(i / 16 * 2 + i % 4 / 2) * 8 + i / 4 % 4 * 2 + i % 2]);
  const auto all_runs = [&](ptrdiff_t length, ptrdiff_t colors) {
    for (auto at = pixels.begin(); at != pixels.end(); at += length) {
      std::vector<uint32_t> run(at, at + length);
      std::sort(run.begin(), run.end());
      if (std::unique(run.begin(), run.end()) - run.begin() > colors) return false;
    }
    return true;
  };
  if (all_runs(4, 1) || all_runs(16, 2)) return 512;
  if (all_runs(2, 1) || all_runs(8, 2)) return 1024;
  return all_runs(4, 2) ? 1536 : 2048;
}

}  // namespace reference
