// AV pixels: decoded frames of libavcodec as 8-bit R,G,B,A.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libswscale/swscale.h>
}

#include "images/image_library.h"

namespace tilepress {

struct AvDelete {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
template <class T>
using AvOwned = std::unique_ptr<T, AvDelete>;

/// Keeps libav's messages off standard error, and forgets the errors of this thread.
void av_begin_messages();
/// The first error message of this thread since av_begin_messages(), else the text of `code`.
std::string av_message(int code);
/// Whether a demultiplexer of this thread reported an error since av_begin_messages().
bool av_demuxer_complained();

/// The header of frames that convert() makes of this format. Fails for formats that are not taken.
Result<ImageHeader> av_header(int width, int height, AVPixelFormat format);

/// Converts frames. RGB, gray and palettes keep their samples. Y'CbCr is converted with the matrix and range
/// that the frame names, BT.601 if it names none, by swscale's exact arithmetic.
class AvPixels {
 public:
  /// `out`: R,G,B,A, tight.
  Result<void> convert(const AVFrame& frame, std::byte* out);

 private:
  Result<void> convert_ycbcr(const AVFrame& frame, std::byte* out);
  AvOwned<SwsContext> scaler_;
  AvOwned<AVFrame> converted_;
};

}  // namespace tilepress
