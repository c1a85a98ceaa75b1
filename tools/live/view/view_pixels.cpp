// View pixels: from the codec's canonical words to the bytes of a texture.
#include "live/view/view_pixels.h"

#include <algorithm>

#include "live/heat_colors.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

constexpr double kLeastAlpha = 70, kMoreAlpha = 130;

ScreenImage frame_image(const LivePicture& picture, uint32_t longest_side) {
  const LivePictureHead& head = picture.head;
  const FormatTraits& format = traits(static_cast<PixelFormat>(head.format));
  const uint64_t longer = std::max(head.width, head.height);
  const uint64_t step = (longer + longest_side - 1) / longest_side;
  ScreenImage out;
  out.width = static_cast<uint32_t>((head.width + step - 1) / step);
  out.height = static_cast<uint32_t>((head.height + step - 1) / step);
  out.bytes.reserve(size_t{out.width} * out.height * 4);
  for (uint64_t y = 0; y < head.height; y += step)
    for (uint64_t x = 0; x < head.width; x += step) {
      const uint32_t word = picture.pixels[y * head.blocks_x * 8 + x];
      for (int c = 0; c < 3; ++c) {
        const uint32_t most = (1u << format.channel_bits[static_cast<size_t>(c)]) - 1;
        out.bytes.push_back(static_cast<uint8_t>((channel(format, word, c) * 255 + most / 2) / most));
      }
      out.bytes.push_back(255);
    }
  return out;
}

ScreenImage heat_image(const LivePicture& picture, size_t scheme, bool opaque) {
  ScreenImage out;
  if (scheme >= picture.bits.size() || picture.bits[scheme].empty()) return out;
  out.width = static_cast<uint32_t>(picture.head.blocks_x);
  out.height = static_cast<uint32_t>(picture.head.blocks_y);
  out.bytes.reserve(picture.bits[scheme].size() * 4);
  for (const uint16_t bits : picture.bits[scheme]) {
    const double share = std::min(1.0, bits / static_cast<double>(picture.head.raw_bits));
    const auto color = heat_color(share);
    out.bytes.insert(out.bytes.end(), color.begin(), color.end());
    out.bytes.push_back(opaque ? 255 : static_cast<uint8_t>(kLeastAlpha + kMoreAlpha * share));
  }
  return out;
}

BlockSummary summarize_blocks(const LivePicture& picture, size_t scheme) {
  BlockSummary out;
  if (scheme >= picture.bits.size()) return out;
  uint64_t sum = 0;
  for (const uint16_t bits : picture.bits[scheme]) {
    ++out.blocks;
    out.raw_blocks += bits >= picture.head.raw_bits;
    out.most_bits = std::max<uint32_t>(out.most_bits, bits);
    sum += bits;
  }
  if (out.blocks > 0) out.mean_bits = static_cast<double>(sum) / static_cast<double>(out.blocks);
  return out;
}

}  // namespace tilepress
