// WebP image: libwebp decodes and composes; alpha stays as it is stored.
#include "images/webp_image.h"

#include <webp/decode.h>
#include <webp/demux.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

namespace tilepress {
namespace {

struct DeleteAnimation {
  void operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }
};
struct DeleteDemuxer {
  void operator()(WebPDemuxer* demuxer) const { WebPDemuxDelete(demuxer); }
};

class WebpImage final : public ImageFile {
 public:
  bool open(const std::string& path, std::string& reason) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    uint32_t riff_bytes = 0;
    if (bytes_.size() >= 12) std::memcpy(&riff_bytes, &bytes_[4], sizeof riff_bytes);
    WebPBitstreamFeatures features;
    const VP8StatusCode status = WebPGetFeatures(data(), bytes_.size(), &features);
    if (bytes_.size() < uint64_t{riff_bytes} + 8 || status == VP8_STATUS_NOT_ENOUGH_DATA)
      reason = "is cut off";
    else if (status != VP8_STATUS_OK)
      reason = "is damaged";
    if (!reason.empty()) return false;
    header_ = {.width = static_cast<uint32_t>(features.width),
               .height = static_cast<uint32_t>(features.height),
               .channels = features.has_alpha || features.has_animation ? 4u : 3u};
    if (!features.has_animation) return true;
    const WebPData whole = {data(), bytes_.size()};
    const std::unique_ptr<WebPDemuxer, DeleteDemuxer> demuxer(WebPDemux(&whole));
    if (demuxer) frame_count_ = WebPDemuxGetI(demuxer.get(), WEBP_FF_FRAME_COUNT);
    if (frame_count_ == 0) reason = "is damaged or cut off";
    return reason.empty();
  }
  bool header(uint32_t image, ImageHeader& out, std::string&) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool is_sequence() const override { return frame_count_ > 0; }

  bool read(uint32_t, uint32_t channels, std::byte* out, std::string& reason) override {
    const int pitch = static_cast<int>(header_.width * channels);
    const size_t size = size_t{header_.width} * channels * header_.height;
    auto* to = reinterpret_cast<uint8_t*>(out);
    if (channels == 4 ? WebPDecodeRGBAInto(data(), bytes_.size(), to, size, pitch) != nullptr
                      : WebPDecodeRGBInto(data(), bytes_.size(), to, size, pitch) != nullptr)
      return true;
    reason = "is damaged or cut off";
    return false;
  }
  bool next(std::byte* out, std::string& reason) override {
    const WebPData whole = {data(), bytes_.size()};
    if (!decoder_) {
      WebPAnimDecoderOptions options;
      if (WebPAnimDecoderOptionsInit(&options) != 0) {
        options.color_mode = MODE_RGBA;
        decoder_.reset(WebPAnimDecoderNew(&whole, &options));
      }
    }
    uint8_t* canvas = nullptr;
    int time_ms = 0;
    if (decoder_ && read_count_ == frame_count_) return false;
    if (!decoder_ || WebPAnimDecoderGetNext(decoder_.get(), &canvas, &time_ms) == 0) {
      reason = "is damaged or cut off";
      return false;
    }
    ++read_count_;
    std::memcpy(out, canvas, size_t{header_.width} * header_.height * 4);
    return true;
  }

 private:
  const uint8_t* data() const { return reinterpret_cast<const uint8_t*>(bytes_.data()); }

  std::vector<char> bytes_;
  ImageHeader header_;
  uint32_t frame_count_ = 0;  ///< 0: a still
  uint32_t read_count_ = 0;
  std::unique_ptr<WebPAnimDecoder, DeleteAnimation> decoder_;
};

}  // namespace

std::unique_ptr<ImageFile> open_webp(const std::string& path, std::string& reason) {
  auto webp = std::make_unique<WebpImage>();
  if (!webp->open(path, reason)) return nullptr;
  return webp;
}

}  // namespace tilepress
