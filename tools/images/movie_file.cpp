// Movie file: every frame that the decoder gives, each once, whatever its time stamp.
#include "images/movie_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <vector>

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/intreadwrite.h>
}

#include "images/av_pixels.h"

namespace tilepress {
namespace {

constexpr int64_t kMostPixels = int64_t{1} << 28;
/// Containers that hold a movie themselves. Playlists, which name other files, are not among them.
constexpr const char* kContainers =
    "mov,matroska,avi,mpeg,mpegts,mpegvideo,h264,hevc,m4v,flv,asf,ogg,ivf,yuv4mpegpipe,nut,mxf,dv,rm,apng,obu,"
    "flic,gxf,wtv,bink,smk,roq,vc1";

struct CloseInput {
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
};

/// Frames of a PNG that is whole; 0 if it is cut off. A picture before the first frame's control is none.
uint32_t count_apng_frames(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  uint32_t frames = 0;
  file.seekg(8);
  for (unsigned char head[8]; file.read(reinterpret_cast<char*>(head), sizeof head);) {
    const uint32_t bytes = AV_RB32(head);
    const std::string_view name(reinterpret_cast<const char*>(head) + 4, 4);
    frames += name == "fcTL";
    file.seekg(bytes + 3ll, std::ios::cur);  // to the last byte of the sum of the chunk
    if (file.get() == std::char_traits<char>::eof()) return 0;
    if (name == "IEND") return frames;
  }
  return 0;
}

/// Whether a Matroska or WebM file is shorter than its segment says; its demultiplexer does not mind.
bool is_cut_matroska(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto file_bytes = static_cast<uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  std::string start(static_cast<size_t>(std::min<uint64_t>(file_bytes, 4096)), '\0');
  file.seekg(0);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  const size_t at = start.starts_with("\x1A\x45\xDF\xA3") ? start.find("\x18\x53\x80\x67") : std::string::npos;
  if (at == std::string::npos || at + 4 >= start.size()) return false;
  // A size of n bytes begins with n - 1 zero bits and a one; all ones after that: not known.
  uint32_t size_bytes = 1;
  while (size_bytes <= 8 && (static_cast<uint8_t>(start[at + 4]) >> (8 - size_bytes)) == 0) ++size_bytes;
  if (size_bytes > 8 || at + 4 + size_bytes > start.size()) return false;
  uint64_t size = static_cast<uint8_t>(start[at + 4]) & (0xFFu >> size_bytes);
  for (uint32_t i = 1; i < size_bytes; ++i) size = size << 8 | static_cast<uint8_t>(start[at + 4 + i]);
  const uint64_t unknown = (uint64_t{1} << (7 * size_bytes)) - 1;
  return size != unknown && size > file_bytes - (at + 4 + size_bytes);
}

class MovieFile final : public ImageFile {
 public:
  /// `apng_frames`: of an animated PNG, all of which must come, or 0.
  bool open(const std::string& path, uint32_t apng_frames, std::string& reason) {
    apng_frames_ = apng_frames;
    av_begin_messages();
    AVFormatContext* input = avformat_alloc_context();
    if (input == nullptr) return false;
    input->format_whitelist = av_strdup(kContainers);
    input->protocol_whitelist = av_strdup("file");
    if (avformat_open_input(&input, ("file:" + path).c_str(), nullptr, nullptr) < 0) return false;
    input_.reset(input);
    if (const int code = avformat_find_stream_info(input, nullptr); code < 0) return fail(code, reason);
    stream_ = av_find_best_stream(input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream_ < 0 || is_cover(stream_)) {
      reason = "holds no movie";
      return false;
    }
    uint32_t movies = 0;
    for (unsigned i = 0; i < input->nb_streams; ++i)
      movies += input->streams[i]->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !is_cover(static_cast<int>(i));
    if (movies > 1)
      left_out_ = "holds " + std::to_string(movies) + " video streams; only stream " + std::to_string(stream_) +
                  " is taken";
    return open_decoder(reason);
  }
  bool header(uint32_t image, ImageHeader& out, std::string&) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool read(uint32_t, uint32_t, std::byte*, std::string&) override { return false; }
  bool is_sequence() const override { return true; }
  std::string left_out() const override { return left_out_; }

  bool next(std::byte* out, std::string& reason) override {
    for (;;) {
      const int code = avcodec_receive_frame(codec_.get(), frame_.get());
      if (code == AVERROR_EOF) return ended(reason);
      if (code == 0) return take(out, reason);
      if (code == AVERROR(EAGAIN) ? !feed(reason) : !tolerates(code, reason)) return false;
    }
  }

 private:
  bool is_cover(int stream) const {
    return (input_->streams[stream]->disposition & (AV_DISPOSITION_ATTACHED_PIC | AV_DISPOSITION_TIMED_THUMBNAILS)) != 0;
  }
  static bool fail(int code, std::string& reason) {
    reason = "cannot be decoded: " + av_reason(code);
    return false;
  }
  bool open_decoder(std::string& reason) {
    const AVStream& stream = *input_->streams[stream_];
    const AVCodec* decoder = avcodec_find_decoder(stream.codecpar->codec_id);
    // Only libvpx decodes the alpha of WebM.
    const AVDictionaryEntry* alpha = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
    if (alpha != nullptr && std::strcmp(alpha->value, "1") == 0) {
      const bool vp8 = stream.codecpar->codec_id == AV_CODEC_ID_VP8;
      decoder = avcodec_find_decoder_by_name(vp8 ? "libvpx" : "libvpx-vp9");
    }
    codec_.reset(avcodec_alloc_context3(decoder));
    packet_.reset(av_packet_alloc());
    frame_.reset(av_frame_alloc());
    if (decoder == nullptr || !codec_ || !packet_ || !frame_) {
      reason = std::string("cannot be decoded: no decoder of ") + avcodec_get_name(stream.codecpar->codec_id);
      return false;
    }
    int code = avcodec_parameters_to_context(codec_.get(), stream.codecpar);
    codec_->pkt_timebase = stream.time_base;
    codec_->err_recognition |= AV_EF_EXPLODE;
    codec_->max_pixels = kMostPixels;
    codec_->thread_count = 1;
    if (code >= 0) code = avcodec_open2(codec_.get(), decoder, nullptr);
    if (code < 0) return fail(code, reason);
    AVPixelFormat format = codec_->pix_fmt;
    if (format == AV_PIX_FMT_NONE) format = static_cast<AVPixelFormat>(stream.codecpar->format);
    if (alpha != nullptr && decoder->wrapper_name != nullptr) format = AV_PIX_FMT_YUVA420P;
    header_ = av_header(stream.codecpar->width, stream.codecpar->height, format);
    if (codec_->codec_id == AV_CODEC_ID_APNG) header_.channels = 4;  // parts may leave the canvas transparent
    return true;
  }
  /// Before the first key frame a stream that was cut out of another cannot be decoded.
  bool tolerates(int code, std::string& reason) {
    return !key_seen_ || fail(code, reason);
  }
  bool feed(std::string& reason) {
    int code = av_read_frame(input_.get(), packet_.get());
    if (code == AVERROR_EOF) {
      avcodec_send_packet(codec_.get(), nullptr);
      return true;
    }
    if (code < 0) return fail(code, reason);
    const bool ours = packet_->stream_index == stream_;
    if (ours && (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0 && key_seen_) {
      reason = "is damaged or cut off";
      return false;
    }
    if (ours) {
      key_seen_ = key_seen_ || (packet_->flags & AV_PKT_FLAG_KEY) != 0;
      code = avcodec_send_packet(codec_.get(), packet_.get());
    }
    av_packet_unref(packet_.get());
    return code >= 0 || tolerates(code, reason);
  }
  bool ended(std::string& reason) {
    if (av_demuxer_complained())
      reason = "is damaged or cut off: " + av_reason(0);
    else if (apng_frames_ != 0 && count_ != apng_frames_)
      reason = "gives " + std::to_string(count_) + " of its " + std::to_string(apng_frames_) + " frames";
    else if (count_ == 0)
      reason = "holds no frame that can be decoded";
    return false;
  }
  bool take(std::byte* out, std::string& reason) {
    const std::string name = "frame " + std::to_string(count_++);
    if (frame_->width != static_cast<int>(header_.width) || frame_->height != static_cast<int>(header_.height))
      reason = name + " has another size";
    else if ((frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame_->decode_error_flags != 0)
      reason = name + " is damaged";
    else if (av_header(1, 1, static_cast<AVPixelFormat>(frame_->format)).channels > header_.channels)
      reason = name + " has alpha, the first one has none";
    return reason.empty() && pixels_.convert(*frame_, out, reason);
  }

  std::unique_ptr<AVFormatContext, CloseInput> input_;
  AvOwned<AVCodecContext> codec_;
  AvOwned<AVPacket> packet_;
  AvOwned<AVFrame> frame_;
  AvPixels pixels_;
  ImageHeader header_;
  std::string left_out_;
  int stream_ = -1;
  bool key_seen_ = false;
  uint64_t count_ = 0;
  uint32_t apng_frames_ = 0;
};

}  // namespace

std::unique_ptr<ImageFile> open_movie(const std::string& path, std::string& reason) {
  auto movie = std::make_unique<MovieFile>();
  const bool cut = is_cut_matroska(path);
  if (cut) reason = "is cut off";
  if (cut || !movie->open(path, 0, reason)) return nullptr;
  return movie;
}

std::unique_ptr<ImageFile> open_apng(const std::string& path, std::string& reason) {
  const uint32_t frames = count_apng_frames(path);
  if (frames == 0) reason = "is cut off";
  auto movie = std::make_unique<MovieFile>();
  if (frames == 0 || !movie->open(path, frames, reason)) return nullptr;
  return movie;
}

bool is_movie_start(std::string_view start) {
  std::vector<uint8_t> padded(start.begin(), start.end());
  padded.resize(start.size() + AVPROBE_PADDING_SIZE);
  const AVProbeData probe = {
      .filename = "", .buf = padded.data(), .buf_size = static_cast<int>(start.size()), .mime_type = nullptr};
  return av_probe_input_format(&probe, 1) != nullptr;
}

}  // namespace tilepress
