// AV still: a whole file is one packet for a decoder of libavcodec.
#include "images/av_still.h"

#include <cstring>
#include <fstream>
#include <iterator>

#include "images/av_pixels.h"

namespace tilepress {
namespace {

constexpr int64_t kMostPixels = int64_t{1} << 28;

AVCodecID codec_of(std::string_view kind, std::string_view bytes) {
  if (kind == "bmp") return AV_CODEC_ID_BMP;
  if (kind == "tga") return AV_CODEC_ID_TARGA;
  if (kind == "dds") return AV_CODEC_ID_DDS;
  if (kind == "psd") return AV_CODEC_ID_PSD;
  if (kind == "sgi") return AV_CODEC_ID_SGI;
  if (kind == "qoi") return AV_CODEC_ID_QOI;
  switch (bytes[1]) {
    case '1':
    case '4':
      return AV_CODEC_ID_PBM;
    case '2':
    case '5':
      return AV_CODEC_ID_PGM;
    case '7':
      return AV_CODEC_ID_PAM;
    default:
      return AV_CODEC_ID_PPM;
  }
}

uint32_t little(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  if (bytes.size() >= at + sizeof value) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Why a DDS is not one picture; empty if it is.
std::string dds_refusal(std::string_view bytes) {
  constexpr uint32_t kCubeMap = 0x200, kVolume = 0x200000;
  const uint32_t kinds = little(bytes, 112);
  if ((kinds & kCubeMap) != 0) return "is a cube map, not one picture";
  if ((kinds & kVolume) != 0) return "is a volume";
  if (bytes.size() > 148 && bytes.substr(84, 4) == "DX10" && little(bytes, 140) > 1)
    return "is an array of " + std::to_string(little(bytes, 140)) + " pictures";
  return {};
}

/// Whether another PNM follows the first, as netpbm's programs write them.
bool is_several_pnm(AVCodecID codec_id, const std::string& bytes) {
  AVCodecParserContext* parser = av_parser_init(codec_id);
  const AvOwned<AVCodecContext> codec(avcodec_alloc_context3(nullptr));
  uint8_t* image = nullptr;
  int image_bytes = 0, consumed = 0;
  if (parser != nullptr && codec)
    consumed = av_parser_parse2(parser, codec.get(), &image, &image_bytes,
                                reinterpret_cast<const uint8_t*>(bytes.data()), static_cast<int>(bytes.size()),
                                AV_NOPTS_VALUE, AV_NOPTS_VALUE, 0);
  av_parser_close(parser);
  return consumed > 0 && std::string_view(bytes).substr(static_cast<size_t>(consumed)).starts_with('P');
}

class AvStill final : public ImageFile {
 public:
  bool open(const std::string& path, std::string_view kind, std::string& reason) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    kind_ = kind;
    AvOwned<AVFrame> frame = decode(reason);
    if (!frame) return false;
    header_ = av_header(frame->width, frame->height, static_cast<AVPixelFormat>(frame->format));
    if (kind_ == "bmp" && frame->format == AV_PIX_FMT_PAL8) header_.channels = 3;
    if (kind_ == "pnm" && is_several_pnm(codec_of(kind_, bytes_), bytes_))
      header_.refusal = "is several images in one file";
    if (kind_ == "dds") {
      if (const std::string other = dds_refusal(bytes_); !other.empty()) header_.refusal = other;
      if (little(bytes_, 28) > 1) left_out_ = "holds smaller copies (mipmaps); only the first level is taken";
    }
    return true;
  }
  bool header(uint32_t image, ImageHeader& out, std::string&) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool read(uint32_t, uint32_t channels, std::byte* out, std::string& reason) override {
    const AvOwned<AVFrame> frame = decode(reason);
    AvPixels pixels;
    if (!frame || !pixels.convert(*frame, out, reason)) return false;
    const size_t count = size_t{header_.width} * header_.height;
    for (size_t i = 0; i < count && channels == 3; ++i) std::memmove(out + i * 3, out + i * 4, 3);
    return true;
  }
  std::string left_out() const override { return left_out_; }

 private:
  AvOwned<AVFrame> decode(std::string& reason) const {
    av_begin_messages();
    const AVCodec* decoder = avcodec_find_decoder(codec_of(kind_, bytes_));
    const AvOwned<AVCodecContext> codec(avcodec_alloc_context3(decoder));
    const AvOwned<AVPacket> packet(av_packet_alloc());
    AvOwned<AVFrame> frame(av_frame_alloc());
    int code = AVERROR(ENOMEM);
    if (decoder != nullptr && codec && packet && frame &&
        (code = av_new_packet(packet.get(), static_cast<int>(bytes_.size()))) >= 0) {
      std::memcpy(packet->data, bytes_.data(), bytes_.size());
      codec->err_recognition |= AV_EF_EXPLODE;
      codec->max_pixels = kMostPixels;
      codec->thread_count = 1;
      code = avcodec_open2(codec.get(), decoder, nullptr);
      if (code >= 0) code = avcodec_send_packet(codec.get(), packet.get());
      if (code >= 0) code = avcodec_send_packet(codec.get(), nullptr);
      if (code >= 0) code = avcodec_receive_frame(codec.get(), frame.get());
    }
    if (code >= 0 && (frame->flags & AV_FRAME_FLAG_CORRUPT) == 0) return frame;
    reason = "is damaged or cut off: " + av_reason(code);
    return nullptr;
  }

  std::string bytes_;
  std::string kind_;
  ImageHeader header_;
  std::string left_out_;
};

}  // namespace

std::unique_ptr<ImageFile> open_av_still(const std::string& path, std::string_view kind, std::string& reason) {
  auto still = std::make_unique<AvStill>();
  if (!still->open(path, kind, reason)) return nullptr;
  return still;
}

}  // namespace tilepress
