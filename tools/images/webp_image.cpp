// WebP image: libwebp decodes and composes; alpha stays as it is stored.
#include "images/image_readers.h"

#include <webp/decode.h>
#include <webp/demux.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "images/image_errors.h"

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
  Result<void> open(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    uint32_t riff_bytes = 0;
    if (bytes_.size() >= 12) std::memcpy(&riff_bytes, &bytes_[4], sizeof riff_bytes);
    WebPBitstreamFeatures features;
    const VP8StatusCode status = WebPGetFeatures(data(), bytes_.size(), &features);
    if (bytes_.size() < uint64_t{riff_bytes} + 8 || status == VP8_STATUS_NOT_ENOUGH_DATA) return cut_off();
    if (status != VP8_STATUS_OK) return Error{ErrorKind::kFile, "is damaged"};
    sequence_ = features.has_animation != 0;
    images_ = {{static_cast<uint32_t>(features.width), static_cast<uint32_t>(features.height),
                features.has_alpha || sequence_ ? 4u : 3u}};
    if (!sequence_) return {};
    const WebPData whole = {data(), bytes_.size()};
    const std::unique_ptr<WebPDemuxer, DeleteDemuxer> demuxer(WebPDemux(&whole));
    if (demuxer) frame_count_ = WebPDemuxGetI(demuxer.get(), WEBP_FF_FRAME_COUNT);
    if (frame_count_ == 0) return damaged();
    return {};
  }

  Result<void> read(uint32_t, std::byte* out) override {
    const uint32_t channels = header().channels;
    const int pitch = static_cast<int>(header().width * channels);
    const size_t size = size_t{header().width} * channels * header().height;
    auto* to = reinterpret_cast<uint8_t*>(out);
    const uint8_t* done = channels == 4 ? WebPDecodeRGBAInto(data(), bytes_.size(), to, size, pitch)
                                        : WebPDecodeRGBInto(data(), bytes_.size(), to, size, pitch);
    if (done == nullptr) return damaged();
    return {};
  }

  Result<bool> next(std::byte* out) override {
    if (read_count_ == frame_count_) return false;
    const WebPData whole = {data(), bytes_.size()};
    WebPAnimDecoderOptions options;
    if (!decoder_ && WebPAnimDecoderOptionsInit(&options) != 0) {
      options.color_mode = MODE_RGBA;
      decoder_.reset(WebPAnimDecoderNew(&whole, &options));
    }
    uint8_t* canvas = nullptr;
    int time_ms = 0;
    if (!decoder_ || WebPAnimDecoderGetNext(decoder_.get(), &canvas, &time_ms) == 0) return damaged();
    ++read_count_;
    std::memcpy(out, canvas, size_t{header().width} * header().height * 4);
    return true;
  }

 private:
  const uint8_t* data() const { return reinterpret_cast<const uint8_t*>(bytes_.data()); }

  std::vector<char> bytes_;
  uint32_t frame_count_ = 0, read_count_ = 0;  ///< of a sequence
  std::unique_ptr<WebPAnimDecoder, DeleteAnimation> decoder_;
};

}  // namespace

OpenedImage open_webp(const std::string& path) {
  return open_with<WebpImage>(path);
}

}  // namespace tilepress
