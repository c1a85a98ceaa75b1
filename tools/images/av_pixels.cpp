// AV pixels: samples as they are where they are RGB, swscale where they are Y'CbCr.
#include "images/av_pixels.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <vector>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "images/image_errors.h"

namespace tilepress {
namespace {

thread_local std::string first_error;
thread_local bool demuxer_complained = false;

void take_message(void* object, int level, const char* format, va_list words) {
  if (level > AV_LOG_ERROR) return;
  const AVClass* kind = object != nullptr ? *static_cast<AVClass**>(object) : nullptr;
  if (kind != nullptr && kind->category == AV_CLASS_CATEGORY_DEMUXER) demuxer_complained = true;
  if (!first_error.empty()) return;
  char line[256];
  std::vsnprintf(line, sizeof line, format, words);
  first_error = line;
}

bool is_ycbcr(const AVPixFmtDescriptor& format) {
  return format.nb_components >= 3 && (format.flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL)) == 0;
}

/// Formats that always have the full range.
bool is_full_range(AVPixelFormat format) {
  return format == AV_PIX_FMT_YUVJ420P || format == AV_PIX_FMT_YUVJ422P || format == AV_PIX_FMT_YUVJ444P ||
         format == AV_PIX_FMT_YUVJ440P || format == AV_PIX_FMT_YUVJ411P;
}

std::string depths_text(const AVPixFmtDescriptor& format) {
  std::string text = std::to_string(format.comp[0].depth);
  for (int c = 1; c < format.nb_components; ++c) (text += '-') += std::to_string(format.comp[c].depth);
  return text;
}

/// Fails for formats that convert() does not take.
Result<void> check_format(AVPixelFormat pixel_format) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(pixel_format);
  if (format == nullptr) return unsupported("has an unknown pixel format");
  constexpr uint64_t kOther = AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_FLOAT;
  const bool one_bit = pixel_format == AV_PIX_FMT_MONOWHITE || pixel_format == AV_PIX_FMT_MONOBLACK;
  if ((format->flags & kOther) != 0 || (format->flags & AV_PIX_FMT_FLAG_BITSTREAM && !one_bit))
    return unsupported(std::string("has pixels of the format ") + format->name + ", which are not taken");
  for (int c = 0; c < format->nb_components; ++c) {
    const int depth = format->comp[c].depth;
    if (depth > 8) return deep_channels(std::to_string(depth) + "-bit");
    if (depth < 8 && !one_bit)
      return unsupported("has pixels of " + depths_text(*format) +
                         " bits; only 8 bits a channel are taken, nothing is widened");
  }
  return {};
}

/// A palette entry is 0xAARRGGBB in the processor's byte order.
void copy_palette_pixels(const AVFrame& frame, std::byte* out) {
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      uint32_t entry = 0;
      std::memcpy(&entry, frame.data[1] + frame.data[0][y * frame.linesize[0] + x] * 4, sizeof entry);
      for (const int shift : {16, 8, 0, 24}) *out++ = static_cast<std::byte>(entry >> shift);
    }
}

/// Copies sample by sample: exact for every layout that the descriptor has.
void copy_samples(const AVFrame& frame, const AVPixFmtDescriptor& format, std::byte* out) {
  const bool gray = format.nb_components < 3;
  const int components[4] = {0, gray ? 0 : 1, gray ? 0 : 2, gray ? 1 : 3};  // of R, G, B, A
  const bool one_bit = format.comp[0].depth == 1;
  const uint16_t flip = frame.format == AV_PIX_FMT_MONOWHITE ? 1 : 0;
  const auto width = static_cast<size_t>(frame.width);
  std::vector<uint16_t> samples(width);
  for (int y = 0; y < frame.height; ++y, out += width * 4)
    for (size_t channel = 0; channel < 4; ++channel) {
      const bool absent = components[channel] >= format.nb_components;
      if (!absent)
        av_read_image_line2(samples.data(), const_cast<const uint8_t**>(frame.data), frame.linesize, &format, 0,
                            y, components[channel], frame.width, 0, sizeof(uint16_t));
      for (size_t x = 0; x < width; ++x) {
        const uint16_t sample = absent ? 255 : one_bit ? (samples[x] ^ flip) * 255 : samples[x];
        out[x * 4 + channel] = static_cast<std::byte>(sample);
      }
    }
}

}  // namespace

void av_begin_messages() {
  static std::once_flag once;
  std::call_once(once, [] { av_log_set_callback(take_message); });
  first_error.clear();
  demuxer_complained = false;
}

std::string av_message(int code) {
  if (!first_error.empty()) return first_error;
  char text[AV_ERROR_MAX_STRING_SIZE] = "";
  av_strerror(code, text, sizeof text);
  return text;
}

bool av_demuxer_complained() { return demuxer_complained; }

Result<ImageHeader> av_header(int width, int height, AVPixelFormat format) {
  if (const auto checked = check_format(format); !checked) return checked.error();
  const bool alpha = (av_pix_fmt_desc_get(format)->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
  return ImageHeader{static_cast<uint32_t>(width), static_cast<uint32_t>(height),
                     alpha || format == AV_PIX_FMT_PAL8 ? 4u : 3u};
}

Result<void> AvPixels::convert(const AVFrame& frame, std::byte* out) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  if (const auto checked = check_format(format); !checked) return checked;
  const AVPixFmtDescriptor& descriptor = *av_pix_fmt_desc_get(format);
  if (is_ycbcr(descriptor)) return convert_ycbcr(frame, out);
  if ((descriptor.flags & AV_PIX_FMT_FLAG_PAL) != 0)
    copy_palette_pixels(frame, out);
  else
    copy_samples(frame, descriptor, out);
  return {};
}

Result<void> AvPixels::convert_ycbcr(const AVFrame& frame, std::byte* out) {
  const AVColorSpace space = frame.colorspace == AVCOL_SPC_UNSPECIFIED ? AVCOL_SPC_SMPTE170M : frame.colorspace;
  switch (space) {
    case AVCOL_SPC_BT709:
    case AVCOL_SPC_FCC:
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
    case AVCOL_SPC_SMPTE240M:
    case AVCOL_SPC_BT2020_NCL:
      break;
    default:
      return unsupported(std::string("has the colour space ") + av_color_space_name(space) +
                         ", which is not converted");
  }
  const auto format = static_cast<AVPixelFormat>(frame.format);
  constexpr int kFlags =
      SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP;
  scaler_.reset(sws_getCachedContext(scaler_.release(), frame.width, frame.height, format, frame.width, frame.height,
                                     AV_PIX_FMT_RGBA, kFlags, nullptr, nullptr, nullptr));
  const int* matrix = sws_getCoefficients(space);
  const bool full = frame.color_range == AVCOL_RANGE_JPEG || is_full_range(format);
  converted_.reset(av_frame_alloc());
  if (scaler_ && converted_) {
    sws_setColorspaceDetails(scaler_.get(), matrix, full ? 1 : 0, matrix, 1, 0, 1 << 16, 1 << 16);
    converted_->width = frame.width;
    converted_->height = frame.height;
    converted_->format = AV_PIX_FMT_RGBA;
  }
  if (!scaler_ || !converted_ || av_frame_get_buffer(converted_.get(), 0) < 0 ||
      sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, converted_->data,
                converted_->linesize) != frame.height)
    return Error{ErrorKind::kSystem, "cannot be converted to RGB"};
  const size_t row_bytes = static_cast<size_t>(frame.width) * 4;
  for (int y = 0; y < frame.height; ++y)
    std::memcpy(out + static_cast<size_t>(y) * row_bytes, converted_->data[0] + y * converted_->linesize[0],
                row_bytes);
  return {};
}

}  // namespace tilepress
