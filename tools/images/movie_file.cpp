// Movie file: every frame that the decoder gives, each once, whatever its time stamp.
#include "images/image_readers.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <vector>

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/intreadwrite.h>
}

#include "images/av_pixels.h"
#include "images/image_errors.h"

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

/// Frames of an animated PNG; 0 if it is cut off. A picture before the first frame control chunk is no frame.
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

/// Whether a Matroska or WebM file is shorter than its segment says. The demultiplexer does not check this.
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
  /// `apng_frames`: the frames that an animated PNG holds; 0 for a movie.
  Result<void> open(const std::string& path, uint32_t apng_frames) {
    apng_frames_ = apng_frames;
    sequence_ = true;
    av_begin_messages();
    AVFormatContext* input = avformat_alloc_context();
    if (input == nullptr) return Error{ErrorKind::kSystem, "not enough memory"};
    input->format_whitelist = av_strdup(kContainers);
    input->protocol_whitelist = av_strdup("file");
    if (avformat_open_input(&input, ("file:" + path).c_str(), nullptr, nullptr) < 0)
      return unsupported("not an image");
    input_.reset(input);
    if (const int code = avformat_find_stream_info(input, nullptr); code < 0) return undecodable(code);
    stream_ = av_find_best_stream(input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream_ < 0 || is_cover(stream_)) return unsupported("holds no movie");
    uint32_t movies = 0;
    for (unsigned i = 0; i < input->nb_streams; ++i)
      movies += input->streams[i]->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !is_cover(static_cast<int>(i));
    if (movies > 1)
      left_out_ = "holds " + std::to_string(movies) + " video streams; only stream " + std::to_string(stream_) +
                  " is taken";
    return open_decoder();
  }
  Result<void> read(uint32_t, std::byte*) override { return unsupported("is a movie, not an image"); }

  Result<bool> next(std::byte* out) override {
    for (;;) {
      const int code = avcodec_receive_frame(codec_.get(), frame_.get());
      Result<void> done;
      if (code == AVERROR_EOF) {
        done = check_end();
        if (done) return false;
      } else if (code == 0) {
        done = take(out);
        if (done) return true;
      } else {
        done = code == AVERROR(EAGAIN) ? feed() : check_decoding(code);
      }
      if (!done) return done.error();
    }
  }

 private:
  bool is_cover(int stream) const {
    return (input_->streams[stream]->disposition & (AV_DISPOSITION_ATTACHED_PIC | AV_DISPOSITION_TIMED_THUMBNAILS)) != 0;
  }
  static Error undecodable(int code) {
    return {ErrorKind::kFile, "cannot be decoded: " + first_line(av_message(code))};
  }
  Result<void> open_decoder() {
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
    if (decoder == nullptr || !codec_ || !packet_ || !frame_)
      return unsupported(std::string("cannot be decoded: no decoder of ") +
                         avcodec_get_name(stream.codecpar->codec_id));
    int code = avcodec_parameters_to_context(codec_.get(), stream.codecpar);
    codec_->pkt_timebase = stream.time_base;
    codec_->err_recognition |= AV_EF_EXPLODE;
    codec_->max_pixels = kMostPixels;
    codec_->thread_count = 1;
    if (code >= 0) code = avcodec_open2(codec_.get(), decoder, nullptr);
    if (code < 0) return undecodable(code);
    AVPixelFormat format = codec_->pix_fmt;
    if (format == AV_PIX_FMT_NONE) format = static_cast<AVPixelFormat>(stream.codecpar->format);
    if (alpha != nullptr && decoder->wrapper_name != nullptr) format = AV_PIX_FMT_YUVA420P;
    const auto header = av_header(stream.codecpar->width, stream.codecpar->height, format);
    if (!header) return header.error();
    images_ = {*header};
    if (codec_->codec_id == AV_CODEC_ID_APNG) images_[0].channels = 4;  // parts may leave the canvas transparent
    return {};
  }
  /// A stream that was cut out of another one cannot be decoded before its first key frame: no error.
  Result<void> check_decoding(int code) const {
    if (code < 0 && key_seen_) return undecodable(code);
    return {};
  }
  /// Gives the decoder the next packet.
  Result<void> feed() {
    int code = av_read_frame(input_.get(), packet_.get());
    if (code == AVERROR_EOF) {
      avcodec_send_packet(codec_.get(), nullptr);
      return {};
    }
    if (code < 0) return undecodable(code);
    const bool ours = packet_->stream_index == stream_;
    if (ours && (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0 && key_seen_) return damaged();
    if (ours) {
      key_seen_ = key_seen_ || (packet_->flags & AV_PKT_FLAG_KEY) != 0;
      code = avcodec_send_packet(codec_.get(), packet_.get());
    }
    av_packet_unref(packet_.get());
    return check_decoding(code);
  }
  /// Fails if frames are missing.
  Result<void> check_end() const {
    if (av_demuxer_complained()) return damaged(av_message(0));
    if (apng_frames_ != 0 && count_ != apng_frames_)
      return Error{ErrorKind::kFile, "gives " + std::to_string(count_) + " of its " +
                                         std::to_string(apng_frames_) + " frames"};
    if (count_ == 0) return Error{ErrorKind::kFile, "holds no frame that can be decoded"};
    return {};
  }
  Result<void> take(std::byte* out) {
    const std::string name = "frame " + std::to_string(count_++);
    if (frame_->width != static_cast<int>(header().width) || frame_->height != static_cast<int>(header().height))
      return unsupported(name + " has another size");
    if ((frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame_->decode_error_flags != 0)
      return Error{ErrorKind::kFile, name + " is damaged"};
    const auto format = av_header(1, 1, static_cast<AVPixelFormat>(frame_->format));
    if (!format) return format.error();
    if (format->channels > header().channels) return unsupported(name + " has alpha, the first one has none");
    return pixels_.convert(*frame_, out);
  }

  std::unique_ptr<AVFormatContext, CloseInput> input_;
  AvOwned<AVCodecContext> codec_;
  AvOwned<AVPacket> packet_;
  AvOwned<AVFrame> frame_;
  AvPixels pixels_;
  int stream_ = -1;
  bool key_seen_ = false;
  uint64_t count_ = 0;
  uint32_t apng_frames_ = 0;
};

}  // namespace

OpenedImage open_movie(const std::string& path) {
  if (is_cut_matroska(path)) return cut_off();
  return open_with<MovieFile>(path, 0u);
}

OpenedImage open_apng(const std::string& path) {
  const uint32_t frames = count_apng_frames(path);
  if (frames == 0) return cut_off();
  return open_with<MovieFile>(path, frames);
}

bool is_movie_start(std::string_view start) {
  std::vector<uint8_t> padded(start.begin(), start.end());
  padded.resize(start.size() + AVPROBE_PADDING_SIZE);
  const AVProbeData probe = {
      .filename = "", .buf = padded.data(), .buf_size = static_cast<int>(start.size()), .mime_type = nullptr};
  return av_probe_input_format(&probe, 1) != nullptr;
}

}  // namespace tilepress
