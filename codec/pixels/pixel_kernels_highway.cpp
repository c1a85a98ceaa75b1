// Pixel kernels by Highway.
#include "cpu/highway_targets.h"
#include "pixels/pixel_kernels.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pixels/pixel_kernels_highway.cpp"
#include "hwy/foreach_target.h"  // before Highway's other headers

#include "cpu/highway.h"
#include "tilepress/block.h"

#if TILEPRESS_HAS_SIMD
TILEPRESS_HIGHWAY_BEGIN

bool LoadTraversal(const uint32_t* HWY_RESTRICT top_left, uint32_t stride, uint32_t* HWY_RESTRICT pixels) {
  const hn::Full128<uint64_t> d;  // two pixels a lane: sub-blocks interleave pairs of two rows
  const auto first = hn::Set(d, uint64_t{top_left[0]} << 32 | top_left[0]);
  auto difference = hn::Zero(d);
  auto* out = reinterpret_cast<uint64_t*>(pixels);
  for (uint32_t y = 0; y < 8; y += 2) {
    const auto* upper = reinterpret_cast<const uint64_t*>(top_left + size_t{y} * stride);
    const auto* lower = reinterpret_cast<const uint64_t*>(top_left + size_t{y + 1} * stride);
    for (uint32_t x = 0; x < 4; x += 2) {
      const auto a = hn::LoadU(d, upper + x), b = hn::LoadU(d, lower + x);
      difference = hn::Or(difference, hn::Or(hn::Xor(a, first), hn::Xor(b, first)));
      hn::StoreU(hn::InterleaveLower(d, a, b), d, out);
      hn::StoreU(hn::InterleaveUpper(d, a, b), d, out + 2);
      out += 4;
    }
  }
  const hn::Full128<uint32_t> d32;
  return hn::AllTrue(d32, hn::Eq(hn::BitCast(d32, difference), hn::Zero(d32)));
}

uint32_t SolidBlocks(const uint32_t* HWY_RESTRICT top_left, uint32_t stride, uint32_t color, uint32_t most) {
  const hn::CappedTag<uint32_t, 8> d;
  const auto wanted = hn::Set(d, color);
  for (uint32_t n = 0; n < most; ++n, top_left += 8) {
    auto difference = hn::Zero(d);
    for (uint32_t y = 0; y < 8; ++y)
      for (size_t x = 0; x < 8; x += hn::Lanes(d))
        difference = hn::Or(difference, hn::Xor(hn::LoadU(d, top_left + size_t{y} * stride + x), wanted));
    if (!hn::AllTrue(d, hn::Eq(difference, hn::Zero(d)))) return n;
  }
  return most;
}

void ReadRaw(const uint8_t* HWY_RESTRICT bytes, uint32_t* HWY_RESTRICT raster) {
  const hn::Full128<uint8_t> d;
  const hn::Full128<uint64_t> d64;  // two pixels a lane
  alignas(16) static constexpr uint8_t kBigEndian[16] = {3,  2,  1, 0, 7,  6,  5,  4,
                                                         11, 10, 9, 8, 15, 14, 13, 12};
  const auto big_endian = hn::Load(d, kBigEndian);
  for (uint32_t y = 0; y < 8; y += 2, raster += 16)
    for (uint32_t x = 0; x < 8; x += 4, bytes += 32) {
      const auto a = hn::BitCast(d64, hn::TableLookupBytes(hn::LoadU(d, bytes), big_endian));
      const auto b = hn::BitCast(d64, hn::TableLookupBytes(hn::LoadU(d, bytes + 16), big_endian));
      hn::StoreU(hn::InterleaveLower(d64, a, b), d64, reinterpret_cast<uint64_t*>(raster + x));
      hn::StoreU(hn::InterleaveUpper(d64, a, b), d64, reinterpret_cast<uint64_t*>(raster + 8 + x));
    }
}

uint32_t ReplaceRow(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                    uint32_t* row, uint8_t* changed_blocks) {
  const Words d;
  const auto bits = hn::Set(d, set_bits), kept = hn::Set(d, 0xFF00FF00u);
  const auto lanes = static_cast<uint32_t>(hn::Lanes(d));
  const auto vector_at = [&](size_t x) HWY_ATTR {
    const auto word = hn::LoadU(d, reinterpret_cast<const uint32_t*>(words) + x);
    if (!swap_red_blue) return hn::Or(word, bits);
    return hn::Or(hn::Or(hn::And(word, kept), hn::AndNot(kept, hn::RotateRight<16>(word))), bits);
  };
  uint32_t changed = 0, x = 0;
  for (; x + lanes <= count; x += lanes) {
    const auto word = vector_at(x);
    const auto differs = hn::Ne(word, hn::LoadU(d, row + x));
    if (hn::AllFalse(d, differs)) continue;  // what stays is not written again
    hn::StoreU(word, d, row + x);
    const uint64_t places = BitsOf(d, differs);
    changed += static_cast<uint32_t>(__builtin_popcountll(places));
    if (changed_blocks == nullptr) continue;
    for (uint32_t lane = 0; lane < lanes; lane += 8)
      changed_blocks[(x + lane) / 8] |= static_cast<uint8_t>(places >> lane);
  }
  return changed + replace_words(words, x, count, swap_red_blue, set_bits, row, changed_blocks);
}

uint64_t RunBegins(const uint32_t* HWY_RESTRICT pixels) {
  const Words d;
  uint64_t begins = 0;
  for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
    const auto now = hn::LoadU(d, pixels + i);
    if (i > 0)
      begins |= BitsOf(d, hn::Ne(now, hn::LoadU(d, pixels + i - 1))) << i;
    else  // from the comparison with the pixels behind
      begins =
          (BitsOf(d, hn::Ne(now, hn::LoadU(d, pixels + 1))) << 1 | 1) & ((uint64_t{1} << hn::Lanes(d)) - 1);
  }
  return begins;
}

uint64_t PlacesOf(const uint32_t* HWY_RESTRICT pixels, uint32_t color) {
  return PlacesIn(pixels, color);
}

bool Split(const uint32_t* HWY_RESTRICT pixels, FewColors& out) {
  uint32_t count = 0, covered = 0;
  for (uint64_t left = ~uint64_t{0}; left != 0; ++count) {
    if (count == FewColors::kMost || covered < count * FewColors::kPixelsPerColor) return false;
    const uint32_t color = pixels[__builtin_ctzll(left)];
    const uint64_t places = PlacesIn(pixels, color);
    out.colors[count] = color;
    out.places[count] = places;
    left &= ~places;
    covered = kBlockPixels - static_cast<uint32_t>(__builtin_popcountll(left));
  }
  out.count = count;
  return true;
}

constexpr PixelKernels kPixelKernels = {.load_traversal = LoadTraversal,
                                        .solid_blocks = SolidBlocks,
                                        .read_raw = ReadRaw,
                                        .replace_row = ReplaceRow,
                                        .run_begins = RunBegins,
                                        .places_of = PlacesOf,
                                        .split = Split};

TILEPRESS_HIGHWAY_END
#endif

#if HWY_ONCE
namespace tilepress {

constexpr KernelSets<PixelKernels> kPixelKernelSets = TILEPRESS_KERNEL_SETS(
    kPlainPixelKernels, kPixelKernels, TILEPRESS_AVX512_OR(kPlainPixelKernels, kPixelKernels));

}  // namespace tilepress
#endif
