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

/// Formats that are of full range by themselves.
bool is_full_range(AVPixelFormat format) {
  return format == AV_PIX_FMT_YUVJ420P || format == AV_PIX_FMT_YUVJ422P || format == AV_PIX_FMT_YUVJ444P ||
         format == AV_PIX_FMT_YUVJ440P || format == AV_PIX_FMT_YUVJ411P;
}

std::string depths_text(const AVPixFmtDescriptor& format) {
  std::string text = std::to_string(format.comp[0].depth);
  for (int c = 1; c < format.nb_components; ++c) (text += '-') += std::to_string(format.comp[c].depth);
  return text;
}

std::string refusal(AVPixelFormat pixel_format) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(pixel_format);
  if (format == nullptr) return "has no pixel format that is known";
  constexpr uint64_t kOther = AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_FLOAT;
  const bool one_bit = pixel_format == AV_PIX_FMT_MONOWHITE || pixel_format == AV_PIX_FMT_MONOBLACK;
  if ((format->flags & kOther) != 0 || (format->flags & AV_PIX_FMT_FLAG_BITSTREAM && !one_bit))
    return std::string("has pixels of the format ") + format->name + ", which are not taken";
  for (int c = 0; c < format->nb_components; ++c) {
    if (format->comp[c].depth > 8) return deep_refusal(std::to_string(format->comp[c].depth) + "-bit");
    if (format->comp[c].depth < 8 && !one_bit)
      return "has pixels of " + depths_text(*format) + " bits; only 8 bits a channel are taken, nothing is widened";
  }
  return {};
}

/// Samples one by one: exact for every layout that the descriptor tells.
void copy_samples(const AVFrame& frame, const AVPixFmtDescriptor& format, std::byte* out) {
  const bool palette = (format.flags & AV_PIX_FMT_FLAG_PAL) != 0;
  const bool gray = !palette && format.nb_components < 3;
  const auto pixel_format = static_cast<AVPixelFormat>(frame.format);
  const bool one_bit = format.comp[0].depth == 1;
  const uint16_t flip = pixel_format == AV_PIX_FMT_MONOWHITE ? 1 : 0;
  const auto width = static_cast<size_t>(frame.width);
  std::vector<uint16_t> samples(width);
  for (int y = 0; y < frame.height; ++y) {
    std::byte* row = out + static_cast<size_t>(y) * width * 4;
    for (int channel = 0; channel < 4; ++channel) {
      const int alpha_at = gray ? 1 : 3;
      const bool absent = channel == 3 && !palette && format.nb_components <= alpha_at;
      const int component = palette ? 0 : channel == 3 ? alpha_at : gray ? 0 : channel;
      if (palette) {  // an entry is 0xAARRGGBB in the processor's order
        for (size_t x = 0; x < width; ++x) {
          uint32_t entry = 0;
          const uint8_t index = frame.data[0][y * frame.linesize[0] + static_cast<ptrdiff_t>(x)];
          std::memcpy(&entry, frame.data[1] + index * 4, sizeof entry);
          row[x * 4 + static_cast<size_t>(channel)] =
              static_cast<std::byte>(entry >> (channel == 3 ? 24 : 16 - 8 * channel));
        }
        continue;
      }
      if (!absent)
        av_read_image_line2(samples.data(), const_cast<const uint8_t**>(frame.data), frame.linesize, &format, 0,
                            y, component, frame.width, 0, sizeof(uint16_t));
      for (size_t x = 0; x < width; ++x) {
        const uint16_t sample = absent ? 255 : one_bit ? (samples[x] ^ flip) * 255 : samples[x];
        row[x * 4 + static_cast<size_t>(channel)] = static_cast<std::byte>(sample);
      }
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

std::string av_reason(int code) {
  if (!first_error.empty()) return first_error;
  char text[AV_ERROR_MAX_STRING_SIZE] = "";
  av_strerror(code, text, sizeof text);
  return text;
}

bool av_demuxer_complained() { return demuxer_complained; }

ImageHeader av_header(int width, int height, AVPixelFormat format) {
  const AVPixFmtDescriptor* descriptor = av_pix_fmt_desc_get(format);
  const bool alpha = descriptor != nullptr && (descriptor->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
  return {.width = static_cast<uint32_t>(width),
          .height = static_cast<uint32_t>(height),
          .channels = alpha || format == AV_PIX_FMT_PAL8 ? 4u : 3u,
          .refusal = refusal(format)};
}

bool AvPixels::convert(const AVFrame& frame, std::byte* out, std::string& reason) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  reason = refusal(format);
  if (!reason.empty()) return false;
  const AVPixFmtDescriptor& descriptor = *av_pix_fmt_desc_get(format);
  if (is_ycbcr(descriptor)) return convert_ycbcr(frame, out, reason);
  copy_samples(frame, descriptor, out);
  return true;
}

bool AvPixels::convert_ycbcr(const AVFrame& frame, std::byte* out, std::string& reason) {
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
      reason = std::string("has the colour space ") + av_color_space_name(space) + ", which is not converted";
      return false;
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
                converted_->linesize) != frame.height) {
    reason = "cannot be converted to RGB";
    return false;
  }
  const size_t row_bytes = static_cast<size_t>(frame.width) * 4;
  for (int y = 0; y < frame.height; ++y)
    std::memcpy(out + static_cast<size_t>(y) * row_bytes, converted_->data[0] + y * converted_->linesize[0],
                row_bytes);
  return true;
}

}  // namespace tilepress
