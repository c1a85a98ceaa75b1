// JPEG image: libjpeg, where missing or damaged data is an error.
#include "images/image_readers.h"

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>
// Needs size_t and FILE.
#include <jpeglib.h>
#include <jerror.h>

#include "images/image_errors.h"

namespace tilepress {
namespace {

/// The number of bytes up to the end of the image; 0 if the image has no end. Thumbnails lie within segments,
/// whose lengths are known. Compressed data holds no marker but restarts.
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

/// One decoding. On an error libjpeg jumps to the setjmp call: the functions between may hold nothing that
/// needs a destructor.
class Decoder {
 public:
  ~Decoder() { jpeg_destroy_decompress(&jpeg_); }
  Result<void> begin(std::string_view bytes) {
    if (!read_header(bytes)) return library_error(failure_);
    return {};
  }
  /// 4 channels: the inks of printers.
  ImageHeader header() const {
    return {jpeg_.image_width, jpeg_.image_height, static_cast<uint32_t>(jpeg_.num_components)};
  }
  Result<void> read(std::byte* out) {
    if (!read_rows(reinterpret_cast<JSAMPROW>(out))) return library_error(failure_);
    return {};
  }
  /// Whether the file is an MPO, which holds several pictures.
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
  /// libjpeg warns when it makes up pixels. These three warnings lose no pixel.
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
  bool read_rows(JSAMPROW out) {
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
  Result<void> open(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    const size_t end = bytes_to_end(bytes_);
    if (end == 0) return cut_off();
    Decoder decoder;
    if (const auto begun = decoder.begin(bytes_); !begun) return begun;
    images_ = {decoder.header()};
    if (decoder.has_mpf())
      left_out_ = "holds further images; only the first is taken";
    else if (std::string_view(bytes_).substr(end).starts_with("\xFF\xD8\xFF"))
      return unsupported("is several JPEGs in one file");
    if (const uint32_t channels = header().channels; channels != 1 && channels != 3)
      return unsupported("has " + std::to_string(channels) + " colour components, not gray or RGB");
    return {};
  }
  Result<void> read(uint32_t, std::byte* out) override {
    Decoder decoder;
    if (const auto begun = decoder.begin(bytes_); !begun) return begun;
    return decoder.read(out);
  }

 private:
  std::string bytes_;
};

}  // namespace

OpenedImage open_jpeg(const std::string& path) {
  return open_with<JpegImage>(path);
}

}  // namespace tilepress
