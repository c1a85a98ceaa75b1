// AV still: a whole file is one packet for a decoder of libavcodec.
#include "images/image_readers.h"

#include <cstring>
#include <fstream>
#include <iterator>

#include "images/av_pixels.h"
#include "images/image_errors.h"

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

/// Fails if a DDS is not one picture.
Result<void> check_dds(std::string_view bytes) {
  constexpr uint32_t kCubeMap = 0x200, kVolume = 0x200000;
  const uint32_t kinds = little(bytes, 112);
  if ((kinds & kCubeMap) != 0) return unsupported("is a cube map, not one picture");
  if ((kinds & kVolume) != 0) return unsupported("is a volume");
  if (bytes.size() > 148 && bytes.substr(84, 4) == "DX10" && little(bytes, 140) > 1)
    return unsupported("is an array of " + std::to_string(little(bytes, 140)) + " pictures");
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
  Result<void> open(const std::string& path, std::string_view kind) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    codec_id_ = codec_of(kind, bytes_);
    const auto frame = decode();
    if (!frame) return frame.error();
    if (kind == "pnm" && is_several_pnm(codec_id_, bytes_)) return unsupported("is several images in one file");
    if (kind == "dds") {
      if (const auto checked = check_dds(bytes_); !checked) return checked;
      if (little(bytes_, 28) > 1) left_out_ = "holds smaller copies (mipmaps); only the first level is taken";
    }
    const auto format = static_cast<AVPixelFormat>((*frame)->format);
    auto header = av_header((*frame)->width, (*frame)->height, format);
    if (!header) return header.error();
    if (kind == "bmp" && format == AV_PIX_FMT_PAL8) header->channels = 3;  // its fourth byte is padding
    images_ = {*header};
    return {};
  }

  Result<void> read(uint32_t, std::byte* out) override {
    const auto frame = decode();
    if (!frame) return frame.error();
    AvPixels pixels;
    if (const auto converted = pixels.convert(**frame, out); !converted) return converted;
    const size_t count = size_t{header().width} * header().height;
    for (size_t i = 0; i < count && header().channels == 3; ++i) std::memmove(out + i * 3, out + i * 4, 3);
    return {};
  }

 private:
  Result<AvOwned<AVFrame>> decode() const {
    av_begin_messages();
    const AVCodec* decoder = avcodec_find_decoder(codec_id_);
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
    if (code < 0 || (frame->flags & AV_FRAME_FLAG_CORRUPT) != 0) return damaged(av_message(code));
    return frame;
  }

  std::string bytes_;
  AVCodecID codec_id_ = AV_CODEC_ID_NONE;
};

}  // namespace

OpenedImage open_av_still(const std::string& path, std::string_view kind) {
  return open_with<AvStill>(path, kind);
}

}  // namespace tilepress
