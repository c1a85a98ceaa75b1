// Plain PNG: libpng without any transformation.
#include "images/plain_png.h"

#include <png.h>

#include <cstdio>

namespace tilepress {
namespace {

constexpr size_t kSignatureBytes = 8;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// What libpng reads a file with. libpng jumps back to whoever called setjmp: there, and on the way there,
/// nothing may need to be destroyed.
class Decoder {
 public:
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  /// False if it cannot be decoded, or is not plain.
  bool begin(const std::string& path) {
    file_.reset(std::fopen(path.c_str(), "rbe"));
    png_byte signature[kSignatureBytes];
    if (file_ == nullptr || std::fread(signature, 1, sizeof signature, file_.get()) != sizeof signature ||
        png_sig_cmp(signature, 0, sizeof signature) != 0)
      return false;
    png_ =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, [](png_structp, png_const_charp) {});
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    return info_ != nullptr && read_header();
  }
  uint32_t width() const { return png_get_image_width(png_, info_); }
  uint32_t height() const { return png_get_image_height(png_, info_); }
  uint32_t channels() const { return png_get_channels(png_, info_); }
  /// Once, after begin().
  bool read_rows(png_bytep out) {
    if (setjmp(png_jmpbuf(png_))) return false;
    const size_t row_bytes = png_get_rowbytes(png_, info_);
    for (size_t y = 0; y < height(); ++y) png_read_row(png_, out + y * row_bytes, nullptr);
    return true;
  }

 private:
  [[noreturn]] static void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }
  bool read_header() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_init_io(png_, file_.get());
    png_set_sig_bytes(png_, kSignatureBytes);
    png_read_info(png_, info_);
    const int type = png_get_color_type(png_, info_);
    return (type == PNG_COLOR_TYPE_RGB || type == PNG_COLOR_TYPE_RGB_ALPHA) &&
           png_get_bit_depth(png_, info_) == 8 && png_get_interlace_type(png_, info_) == PNG_INTERLACE_NONE &&
           png_get_valid(png_, info_, PNG_INFO_tRNS) == 0;
  }

  std::unique_ptr<std::FILE, CloseFile> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

class PlainPng final : public ImageFile {
 public:
  PlainPng(std::string path, std::unique_ptr<Decoder> begun)
      : path_(std::move(path)), begun_(std::move(begun)) {
    header_ = {.width = begun_->width(),
               .height = begun_->height(),
               .channels = begun_->channels(),
               .sample_type = "uint8"};
  }
  std::string kind() const override { return "png"; }
  bool header(uint32_t image, ImageHeader& out) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool read(uint32_t image, uint32_t channels, std::byte* out, std::string& reason) override {
    std::unique_ptr<Decoder> decoder = std::move(begun_);
    if (decoder == nullptr) {  // read before
      decoder = std::make_unique<Decoder>();
      if (!decoder->begin(path_)) decoder.reset();
    }
    const bool same = decoder != nullptr && image == 0 && channels == header_.channels &&
                      decoder->width() == header_.width && decoder->height() == header_.height &&
                      decoder->channels() == header_.channels;
    if (same && decoder->read_rows(reinterpret_cast<png_bytep>(out))) return true;
    const ImageLibrary* library = image_library(reason);
    const std::unique_ptr<ImageFile> file = library != nullptr ? library->open(path_, reason) : nullptr;
    ImageHeader now;
    return file != nullptr && file->header(image, now) && now.width == header_.width &&
           now.height == header_.height && now.channels == channels &&
           now.sample_type == header_.sample_type && file->read(image, channels, out, reason);
  }

 private:
  const std::string path_;
  ImageHeader header_;
  std::unique_ptr<Decoder> begun_;  ///< until it is read
};

}  // namespace

std::unique_ptr<ImageFile> open_plain_png(const std::string& path) {
  auto decoder = std::make_unique<Decoder>();
  if (!decoder->begin(path)) return nullptr;
  return std::make_unique<PlainPng>(path, std::move(decoder));
}

}  // namespace tilepress
