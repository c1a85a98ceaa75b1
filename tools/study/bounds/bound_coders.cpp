// Bound coders: liblz4, libzstd and libwebp.
#include "bound_coders.h"

#include <lz4.h>
#include <webp/encode.h>
#include <zstd.h>

#include <algorithm>

namespace tilepress {
namespace {

enum BoundIndex : size_t { kLz4Block, kZstdBlock, kLz4Frame, kZstdFrame, kWebpFrame };

constexpr int kZstdLevel = 3, kWebpLevel = 0;
/// Magic number, descriptor and content size of a zstd frame of 256 bytes.
constexpr size_t kZstdHeaderBytes = 4 + 1 + 2;
constexpr uint64_t kRawBlockBits = kMaxRawBlockBits;

/// Adds data of `raw_bits` that a coder stores in `bytes`; 0 bytes: the coder failed.
void add_coded(size_t bytes, uint64_t raw_bits, SchemeStatistics& sums) {
  const uint64_t bits = bytes == 0 ? raw_bits : std::min<uint64_t>(bytes * 8, raw_bits);
  sums.payload_bits += bits;
  sums.bursts += (bits + sums.burst_bits - 1) / sums.burst_bits;
}

struct DeleteZstd {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

class WebpPicture {
 public:
  WebpPicture() : valid_(WebPPictureInit(&picture_) != 0) {}
  ~WebpPicture() { WebPPictureFree(&picture_); }
  WebpPicture(const WebpPicture&) = delete;
  WebpPicture& operator=(const WebpPicture&) = delete;

  Result<size_t> coded_bytes(const std::vector<uint32_t>& pixels, uint32_t width, uint32_t height) {
    WebPConfig config;
    size_t bytes = 0;
    if (!valid_ || !WebPConfigInit(&config) || !WebPConfigLosslessPreset(&config, kWebpLevel))
      return Error{ErrorKind::kSystem, "libwebp has another version than its header"};
    config.exact = 1;
    picture_.use_argb = 1;
    picture_.width = static_cast<int>(width);
    picture_.height = static_cast<int>(height);
    picture_.custom_ptr = &bytes;
    picture_.writer = [](const uint8_t*, size_t size, const WebPPicture* picture) {
      *static_cast<size_t*>(picture->custom_ptr) += size;
      return 1;
    };
    const auto* rgba = reinterpret_cast<const uint8_t*>(pixels.data());
    if (!WebPPictureImportRGBA(&picture_, rgba, static_cast<int>(width * 4)) || !WebPEncode(&config, &picture_))
      return Error{ErrorKind::kSystem, "libwebp: error " + std::to_string(picture_.error_code)};
    return bytes;
  }

 private:
  WebPPicture picture_;
  bool valid_;
};

}  // namespace

struct BoundCoders::Contexts {
  std::vector<std::byte> lz4 = std::vector<std::byte>(static_cast<size_t>(LZ4_sizeofState()));
  std::unique_ptr<ZSTD_CCtx, DeleteZstd> zstd{ZSTD_createCCtx()};
  std::vector<char> coded;
  std::vector<uint32_t> pixels;  ///< of a frame, tight
};

const std::vector<std::string>& bound_names() {
  static const std::vector<std::string> kNames = {"lz4_block", "zstd_block", "lz4_frame", "zstd_frame",
                                                  "webp_frame"};
  return kNames;
}

bool has_bounds(PixelFormat format) {
  return format == PixelFormat::kRgba8 || format == PixelFormat::kRgbx8;
}

BoundCoders::BoundCoders() : contexts_(std::make_unique<Contexts>()) {}
BoundCoders::~BoundCoders() = default;

size_t BoundCoders::lz4_bytes(std::span<const uint32_t> pixels) {
  if (pixels.size_bytes() > LZ4_MAX_INPUT_SIZE) return 0;
  const int size = static_cast<int>(pixels.size_bytes());
  std::vector<char>& coded = contexts_->coded;
  coded.resize(std::max(coded.size(), static_cast<size_t>(LZ4_compressBound(size))));
  return static_cast<size_t>(LZ4_compress_fast_extState(contexts_->lz4.data(),
                                                        reinterpret_cast<const char*>(pixels.data()), coded.data(),
                                                        size, static_cast<int>(coded.size()), 1));
}

size_t BoundCoders::zstd_bytes(std::span<const uint32_t> pixels) {
  std::vector<char>& coded = contexts_->coded;
  coded.resize(std::max(coded.size(), ZSTD_compressBound(pixels.size_bytes())));
  const size_t bytes = ZSTD_compressCCtx(contexts_->zstd.get(), coded.data(), coded.size(), pixels.data(),
                                         pixels.size_bytes(), kZstdLevel);
  return ZSTD_isError(bytes) ? 0 : bytes;
}

void BoundCoders::measure_blocks(const PixelPlane& frame, SchemeStatistics& lz4, SchemeStatistics& zstd) {
  Block block{}, before{};
  std::array<uint32_t, kBlockPixels> words{};
  size_t lz4_size = 0, zstd_size = 0;  // of `before`: equal neighbours are common
  for (uint32_t by = 0; by < frame.blocks_y(); ++by)
    for (uint32_t bx = 0; bx < frame.blocks_x(); ++bx) {
      frame.load_block(bx, by, block);
      if (zstd_size == 0 || block != before) {
        for (uint32_t i = 0; i < kBlockPixels; ++i) words[i] = block.pixels[kTraversal[i]];
        lz4_size = lz4_bytes(words);
        zstd_size = zstd_bytes(words);
        before = block;
      }
      add_coded(lz4_size, kRawBlockBits, lz4);
      add_coded(zstd_size > kZstdHeaderBytes ? zstd_size - kZstdHeaderBytes : 0, kRawBlockBits, zstd);
    }
}

Result<void> BoundCoders::measure(const PixelPlane& frame, uint32_t burst_bits,
                                  std::vector<SchemeStatistics>& out) {
  SchemeStatistics empty;
  empty.blocks = frame.blocks();
  empty.raw_bits = frame.blocks() * kRawBlockBits;
  empty.burst_bits = burst_bits;
  out.assign(bound_names().size(), empty);
  measure_blocks(frame, out[kLz4Block], out[kZstdBlock]);
  std::vector<uint32_t>& pixels = contexts_->pixels;
  pixels.clear();
  for (uint32_t y = 0; y < frame.height(); ++y)
    pixels.insert(pixels.end(), frame.row(y), frame.row(y) + frame.width());
  add_coded(lz4_bytes(pixels), empty.raw_bits, out[kLz4Frame]);
  add_coded(zstd_bytes(pixels), empty.raw_bits, out[kZstdFrame]);
  if (std::max(frame.width(), frame.height()) > WEBP_MAX_DIMENSION) {
    out[kWebpFrame] = {.burst_bits = burst_bits, .skipped = true};
    return {};
  }
  const auto webp = WebpPicture().coded_bytes(pixels, frame.width(), frame.height());
  if (!webp) return webp.error();
  add_coded(*webp, empty.raw_bits, out[kWebpFrame]);
  return {};
}

}  // namespace tilepress
