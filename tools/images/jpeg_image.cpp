// JPEG image: libjpeg, where missing or damaged data is an error.
#include "images/jpeg_image.h"

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>
// Needs size_t and FILE.
#include <jpeglib.h>
#include <jerror.h>

namespace tilepress {
namespace {

/// The bytes up to and with the end of the image; 0 if it has none. Thumbnails lie within segments, which have
/// lengths, and compressed data holds no marker but restarts.
size_t bytes_to_end(std::string_view jpeg) {
  constexpr uint8_t kRestart0 = 0xD0, kRestart7 = 0xD7, kEnd = 0xD9, kTemporary = 0x01;
  for (size_t at = 2; (at = jpeg.find('\xFF', at)) != std::string_view::npos && at + 1 < jpeg.size();) {
    const auto marker = static_cast<uint8_t>(jpeg[at + 1]);
    at += marker == 0xFF ? 1 : 2;
    if (marker == kEnd) return at;
    if (marker == 0xFF || marker == 0 || marker == kTemporary ||
        (marker >= kRestart0 && marker <= kRestart7))
      continue;
    if (at + 2 > jpeg.size()) return 0;
    at += static_cast<uint8_t>(jpeg[at]) * 256u + static_cast<uint8_t>(jpeg[at + 1]);
  }
  return 0;
}

/// One decoding. libjpeg jumps back to whoever called setjmp: there, and on the way there, nothing may need
/// to be destroyed.
class Decoder {
 public:
  ~Decoder() { jpeg_destroy_decompress(&jpeg_); }
  bool begin(std::string_view bytes, std::string& reason) {
    if (read_header(bytes)) return true;
    reason = failure_;
    return false;
  }
  uint32_t width() const { return jpeg_.image_width; }
  uint32_t height() const { return jpeg_.image_height; }
  /// 4 for the inks of printers.
  uint32_t channels() const { return static_cast<uint32_t>(jpeg_.num_components); }
  bool read_rows(std::byte* out, std::string& reason) {
    if (rows_read(reinterpret_cast<JSAMPROW>(out))) return true;
    reason = failure_;
    return false;
  }
  /// Whether it is one of several pictures of a file (MPO).
  bool has_mpf() const {
    for (const jpeg_marker_struct* each = jpeg_.marker_list; each != nullptr; each = each->next)
      if (each->data_length >= 4 && each->data[0] == 'M' && each->data[1] == 'P' && each->data[2] == 'F' &&
          each->data[3] == 0)
        return true;
    return false;
  }

 private:
  [[noreturn]] static void give_up(j_common_ptr jpeg) {
    auto* decoder = static_cast<Decoder*>(jpeg->client_data);
    char message[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, message);
    const bool ended = jpeg->err->msg_code == JERR_INPUT_EOF || jpeg->err->msg_code == JERR_INPUT_EMPTY ||
                       jpeg->err->msg_code == JWRN_JPEG_EOF;
    std::snprintf(decoder->failure_, sizeof decoder->failure_, "%s", ended ? "is cut off" : message);
    std::longjmp(decoder->back_, 1);
  }
  /// Warnings are about pixels that libjpeg makes up. The exceptions lose no pixel.
  static void warn(j_common_ptr jpeg, int level) {
    const int code = jpeg->err->msg_code;
    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM && code != JWRN_JFIF_MAJOR)
      give_up(jpeg);
  }
  bool read_header(std::string_view bytes) {
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = give_up;
    errors_.emit_message = warn;
    jpeg_.client_data = this;
    if (setjmp(back_)) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.client_data = this;
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 2, 0xFFFF);
    jpeg_read_header(&jpeg_, TRUE);
    if (jpeg_.num_components == 3) jpeg_.out_color_space = JCS_RGB;
    return true;
  }
  bool rows_read(JSAMPROW out) {
    if (setjmp(back_)) return false;
    jpeg_start_decompress(&jpeg_);
    const size_t pitch = size_t{jpeg_.output_width} * static_cast<size_t>(jpeg_.output_components);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = out + jpeg_.output_scanline * pitch;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  jpeg_decompress_struct jpeg_ = {};
  jpeg_error_mgr errors_ = {};
  std::jmp_buf back_;
  char failure_[JMSG_LENGTH_MAX] = "";
};

class JpegImage final : public ImageFile {
 public:
  bool open(const std::string& path, std::string& reason) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    const size_t end = bytes_to_end(bytes_);
    if (end == 0) reason = "is cut off";
    Decoder decoder;
    if (end == 0 || !decoder.begin(bytes_, reason)) return false;
    header_ = {.width = decoder.width(), .height = decoder.height(), .channels = decoder.channels()};
    if (decoder.channels() != 1 && decoder.channels() != 3)
      header_.refusal = "has " + std::to_string(decoder.channels()) + " colour components, not gray or RGB";
    if (decoder.has_mpf()) left_out_ = "holds further images; only the first is taken";
    else if (std::string_view(bytes_).substr(end).starts_with("\xFF\xD8\xFF"))
      header_.refusal = "is several JPEGs in one file";
    return true;
  }
  bool header(uint32_t image, ImageHeader& out, std::string&) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool read(uint32_t, uint32_t channels, std::byte* out, std::string& reason) override {
    Decoder decoder;
    if (!decoder.begin(bytes_, reason)) return false;
    if (decoder.width() != header_.width || decoder.height() != header_.height ||
        decoder.channels() != channels)
      return false;
    return decoder.read_rows(out, reason);
  }
  std::string left_out() const override { return left_out_; }

 private:
  std::string bytes_;
  ImageHeader header_;
  std::string left_out_;
};

}  // namespace

std::unique_ptr<ImageFile> open_jpeg(const std::string& path, std::string& reason) {
  auto jpeg = std::make_unique<JpegImage>();
  if (!jpeg->open(path, reason)) return nullptr;
  return jpeg;
}

}  // namespace tilepress
