// Reference model: sizes of the formats of shipping GPUs, by trying every form.
#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "reference_model.h"

namespace reference {
namespace {

struct Pixel {
  int r, g, b, a;
  bool operator==(const Pixel&) const = default;
};
Pixel pixel_at(const std::vector<uint32_t>& block, uint32_t x, uint32_t y) {
  const uint32_t word = block[8 * y + x];
  return {static_cast<int>(word % 256), static_cast<int>(word / 256 % 256),
          static_cast<int>(word / 65536 % 256), static_cast<int>(word / 16777216)};
}
std::vector<Pixel> rectangle(const std::vector<uint32_t>& block, uint32_t x0, uint32_t y0, uint32_t width,
                             uint32_t height) {
  std::vector<Pixel> pixels;
  for (uint32_t y = y0; y < y0 + height; ++y)
    for (uint32_t x = x0; x < x0 + width; ++x) pixels.push_back(pixel_at(block, x, y));
  return pixels;
}

int modulo(int value) {
  return (value % 256 + 256) % 256;
}

using Channel = std::function<int(const Pixel&)>;
const Channel kRed = [](const Pixel&p) { return p.r; }, kGreen = [](const Pixel&p) { return p.g; },
              kBlue = [](const Pixel&p) { return p.b; }, kAlpha = [](const Pixel&p) { return p.a; },
              kRedFromBlue = [](const Pixel&p) { return modulo(p.r - p.b); },
              kGreenFromBoth = [](const Pixel&p) { return modulo(p.g - (p.b + p.r) / 2); };

/// Bits for all values without a wrap: the base is the smallest.
int plain_width(const std::vector<Pixel>& pixels, const Channel& channel) {
  int low = 255, high = 0;
  for (const Pixel& pixel : pixels) {
    low = std::min(low, channel(pixel));
    high = std::max(high, channel(pixel));
  }
  int width = 0;
  while (low + (1 << width) <= high) ++width;
  return width;
}

/// Bits for all values from any base, with a wrap: all but the longest gap in the circle of 256 values.
int window_width(const std::vector<Pixel>& pixels, const Channel& channel) {
  std::array<bool, 256> present{};
  for (const Pixel& pixel : pixels) present[static_cast<size_t>(channel(pixel))] = true;
  int gap = 0, longest = 0;
  for (size_t i = 0; i < 512; ++i) {
    gap = present[i % 256] ? 0 : gap + 1;
    longest = std::max(longest, gap);
  }
  int width = 0;
  while (1 << width < 256 - longest) ++width;
  return width;
}

int sum_of_widths(const std::vector<Pixel>& pixels) {
  return plain_width(pixels, kRed) + plain_width(pixels, kGreen) + plain_width(pixels, kBlue) +
         plain_width(pixels, kAlpha);
}
int least_sum_of_widths(const std::vector<Pixel>& pixels) {
  return std::min(sum_of_widths(pixels), plain_width(pixels, kBlue) + plain_width(pixels, kAlpha) +
                                             window_width(pixels, kRedFromBlue) +
                                             window_width(pixels, kGreenFromBoth));
}

uint32_t intel8_bits(const std::vector<uint32_t>& block) {
  uint32_t bits = 0;
  for (const uint32_t y : {0u, 4u}) bits += sum_of_widths(rectangle(block, 0, y, 8, 4)) <= 14 ? 512 : 1024;
  return bits;
}

uint32_t intel11_pair_bits(const std::vector<uint32_t>& block, uint32_t y) {
  const int pair = least_sum_of_widths(rectangle(block, 0, y, 8, 4));
  const bool left = least_sum_of_widths(rectangle(block, 0, y, 4, 4)) <= 12;
  const bool right = least_sum_of_widths(rectangle(block, 4, y, 4, 4)) <= 12;
  uint32_t uniform = 0;
  for (uint32_t quad = 0; quad < 8; ++quad) {
    const auto pixels = rectangle(block, quad % 4 * 2, y + quad / 4 * 2, 2, 2);
    if (std::count(pixels.begin(), pixels.end(), pixels[0]) == 4) ++uniform;
  }
  if (pair <= 6) return 256;
  if ((left && right) || pair <= 14 || (pair <= 22 && uniform >= 4)) return 512;
  return left || right ? 768 : 1024;
}

/// The pixels of a half line, and which pixel each is predicted from.
constexpr uint32_t kX[] = {0, 1, 0, 1, 2, 3, 2, 3}, kY[] = {0, 0, 1, 1, 0, 0, 1, 1};
constexpr int kFrom[] = {-1, 0, 0, 2, 1, 4, 4, 6};

/// Planes that difference `value` takes: it is 0 … 2^n − 1, or the one's complement of that.
int planes_of(int value) {
  const int wrapped = modulo(value);
  int planes = 0;
  while (wrapped >= 1 << planes && 255 - wrapped >= 1 << planes) ++planes;
  return planes;
}
int planes_of(const std::vector<int>& half) {
  int planes = 0;
  for (uint32_t i = 1; i < 8; ++i) planes = std::max(planes, planes_of(half[i] - half[kFrom[i]]));
  return planes;
}

/// Bits of one channel of a line under a combination of flags, or −1 if they cannot say it.
int dcc_bits(const std::vector<int>& left, const std::vector<int>& right, const std::string& flags) {
  const bool left_byte = flags[0] == '1', right_byte = flags[1] == '1', left_constant = flags[2] == '1',
             right_constant = flags[3] == '1';
  const int last = left[5];
  int bits = 8 * left_byte + 8 * right_byte, left_planes = left_byte ? planes_of(left) : 7;
  if (left_constant) {
    if (std::count(left.begin(), left.end(), left_byte ? left[0] : 0) != 8) return -1;
  }
  if (right_constant) {
    if (std::count(right.begin(), right.end(), right_byte ? right[0] : last) != 8) return -1;
  }
  int right_planes = planes_of(right);
  if (!right_constant && !right_byte) {  // as many planes as the left half, and u0 is predicted too
    right_planes = std::max(right_planes, planes_of(right[0] - last));
    if (left_constant) return -1;
    if (!left_byte && right_planes > 7) return -1;
    left_planes = right_planes = std::max(left_planes, right_planes);
  }
  if (!left_constant) bits += 8 + 8 * left_planes;
  if (!right_constant) bits += 8 + 8 * right_planes;
  return bits;
}

int dcc_line_bits(const std::vector<uint32_t>& block, uint32_t y) {
  int bits = 16;
  for (uint32_t c = 0; c < 4; ++c) {
    std::vector<int> halves[2];
    for (uint32_t half = 0; half < 2; ++half)
      for (uint32_t i = 0; i < 8; ++i) {
        const Pixel p = pixel_at(block, 4 * half + kX[i], y + kY[i]);
        const int channels[] = {p.g, modulo(p.r - p.g), modulo(p.b - p.g), p.a};
        halves[half].push_back(channels[c]);
      }
    int least = 1 << 20;
    for (const char* flags : {"0001", "0011", "0101", "1000", "1001", "1011", "1100", "1101", "1110", "1111"})
      if (const int form = dcc_bits(halves[0], halves[1], flags); form >= 0) least = std::min(least, form);
    bits += least;
  }
  return bits;
}

uint32_t amddcc_bits(const std::vector<uint32_t>& block) {
  int line_bits[4];
  for (uint32_t line = 0; line < 4; ++line) line_bits[line] = dcc_line_bits(block, 2 * line);
  uint32_t least = 2048;
  for (uint32_t cuts = 0; cuts < 8; ++cuts) {  // bit i: a group ends behind line i
    uint32_t total = 0, lines = 0;
    int bits = 0;
    bool legal = true;
    for (uint32_t line = 0; line < 4; ++line) {
      bits += line_bits[line];
      ++lines;
      if (line < 3 && (cuts >> line & 1) == 0) continue;
      legal = legal && (lines == 1 || bits <= 512);
      total += 512;
      bits = 0;
      lines = 0;
    }
    if (legal) least = std::min(least, total);
  }
  return least;
}

}  // namespace

bool is_of_hardware(const std::string& scheme) {
  return scheme == "intel8" || scheme == "intel11" || scheme == "amddcc";
}

uint32_t hardware_bits(const std::vector<uint32_t>& block, const std::string& scheme) {
  if (scheme == "intel8") return intel8_bits(block);
  if (scheme == "intel11") return intel11_pair_bits(block, 0) + intel11_pair_bits(block, 4);
  return amddcc_bits(block);
}

uint32_t hardware_csb_bits(const std::string& scheme) {
  return scheme == "intel8" ? 4 : 8;
}

}  // namespace reference
