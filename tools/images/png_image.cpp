// PNG image: libpng, which expands samples to 8 bits and changes nothing else.
#include "images/png_image.h"

#include <png.h>
#include <sys/stat.h>

#include <cstdio>
#include <cstring>

namespace tilepress {
namespace {

/// Deflate makes at most this many bytes of one.
constexpr uint64_t kMostInflation = 1032;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// What libpng reads a file with. libpng jumps back to whoever called setjmp: there, and on the way there,
/// nothing may need to be destroyed.
class Decoder {
 public:
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  /// False and a reason if the header cannot be decoded.
  bool begin(const std::string& path, std::string& reason) {
    file_.reset(std::fopen(path.c_str(), "rbe"));
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, give_up, [](png_structp, png_const_charp) {});
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (file_ != nullptr && info_ != nullptr && read_header()) return true;
    reason = failure_;
    return false;
  }
  uint32_t width() const { return png_get_image_width(png_, info_); }
  uint32_t height() const { return png_get_image_height(png_, info_); }
  uint32_t channels() const { return png_get_channels(png_, info_); }
  bool is_deep() const { return png_get_bit_depth(png_, info_) > 8; }
  bool is_animation() const { return animated_; }
  /// Whether the file is too short for the pixels that the header announces.
  bool is_too_short() const {
    struct stat status {};
    return fstat(fileno(file_.get()), &status) == 0 &&
           stored_bytes_ > static_cast<uint64_t>(status.st_size) * kMostInflation;
  }
  /// Once, after begin().
  bool read_rows(png_bytep out, std::string& reason) {
    if (rows_read(out)) return true;
    reason = failure_;
    return false;
  }

 private:
  [[noreturn]] static void give_up(png_structp png, png_const_charp message) {
    auto* decoder = static_cast<Decoder*>(png_get_error_ptr(png));
    const bool ended = std::feof(decoder->file_.get()) != 0;
    std::snprintf(decoder->failure_, sizeof decoder->failure_, "%s", ended ? "Read error: hit end of file" : message);
    png_longjmp(png, 1);
  }
  /// Animations announce themselves before the pixels. One frame that is the picture itself is a plain PNG.
  static int note_chunk(png_structp png, png_unknown_chunkp chunk) {
    if (std::memcmp(chunk->name, "acTL", 4) == 0)
      static_cast<Decoder*>(png_get_user_chunk_ptr(png))->animated_ = true;
    return 1;
  }
  bool read_header() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_init_io(png_, file_.get());
    png_set_read_user_chunk_fn(png_, this, note_chunk);
    png_read_info(png_, info_);
    stored_bytes_ = uint64_t{png_get_rowbytes(png_, info_)} * height();
    png_set_expand(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool rows_read(png_bytep out) {
    if (setjmp(png_jmpbuf(png_))) return false;
    const size_t row_bytes = png_get_rowbytes(png_, info_);
    const int passes = png_get_interlace_type(png_, info_) == PNG_INTERLACE_NONE ? 1 : 7;
    for (int pass = 0; pass < passes; ++pass)
      for (size_t y = 0; y < height(); ++y) png_read_row(png_, out + y * row_bytes, nullptr);
    png_read_end(png_, nullptr);
    return true;
  }

  std::unique_ptr<std::FILE, CloseFile> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  uint64_t stored_bytes_ = 0;
  bool animated_ = false;
  char failure_[128] = "";
};

class PngImage final : public ImageFile {
 public:
  PngImage(std::string path, std::unique_ptr<Decoder> begun)
      : path_(std::move(path)), begun_(std::move(begun)) {
    header_ = {.width = begun_->width(), .height = begun_->height(), .channels = begun_->channels()};
    if (begun_->is_deep()) header_.refusal = deep_refusal("uint16");
  }
  bool header(uint32_t image, ImageHeader& out, std::string&) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool read(uint32_t image, uint32_t channels, std::byte* out, std::string& reason) override {
    std::unique_ptr<Decoder> decoder = std::move(begun_);
    if (decoder == nullptr) {  // read before
      decoder = std::make_unique<Decoder>();
      if (!decoder->begin(path_, reason)) return false;
    }
    if (image != 0 || channels != header_.channels || decoder->width() != header_.width ||
        decoder->height() != header_.height || decoder->channels() != channels || decoder->is_deep())
      return false;
    return decoder->read_rows(reinterpret_cast<png_bytep>(out), reason);
  }

 private:
  const std::string path_;
  ImageHeader header_;
  std::unique_ptr<Decoder> begun_;  ///< until it is read
};

}  // namespace

std::unique_ptr<ImageFile> open_png(const std::string& path, std::string& reason) {
  auto decoder = std::make_unique<Decoder>();
  if (!decoder->begin(path, reason)) return nullptr;
  if (decoder->is_animation()) return nullptr;
  if (decoder->is_too_short()) {
    reason = "is cut off";
    return nullptr;
  }
  return std::make_unique<PngImage>(path, std::move(decoder));
}

}  // namespace tilepress
