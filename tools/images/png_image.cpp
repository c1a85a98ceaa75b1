// PNG image: libpng, which expands samples to 8 bits and changes nothing else.
#include "images/image_readers.h"

#include <png.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "images/image_errors.h"

namespace tilepress {
namespace {

/// Deflate makes at most this many bytes of one.
constexpr uint64_t kMostInflation = 1032;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// One pass of libpng over a file. On an error libpng jumps to the setjmp call: the functions between may
/// hold nothing that needs a destructor.
class Decoder {
 public:
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  /// Reads the header.
  Result<void> begin(const std::string& path) {
    file_.reset(std::fopen(path.c_str(), "rbe"));
    if (file_ == nullptr) return Error{ErrorKind::kFile, std::strerror(errno)};
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, give_up, [](png_structp, png_const_charp) {});
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr || !read_header()) return library_error(failure_);
    return {};
  }
  ImageHeader header() const {
    return {png_get_image_width(png_, info_), png_get_image_height(png_, info_),
            png_get_channels(png_, info_)};
  }
  bool is_deep() const { return png_get_bit_depth(png_, info_) > 8; }
  bool is_animation() const { return animated_; }
  /// Whether the file is too short for the pixels that the header announces.
  bool is_too_short() const {
    struct stat status {};
    return fstat(fileno(file_.get()), &status) == 0 &&
           stored_bytes_ > static_cast<uint64_t>(status.st_size) * kMostInflation;
  }
  /// Call once, after begin().
  Result<void> read(png_bytep out) {
    if (!read_rows(out)) return library_error(failure_);
    return {};
  }

 private:
  [[noreturn]] static void give_up(png_structp png, png_const_charp message) {
    auto* decoder = static_cast<Decoder*>(png_get_error_ptr(png));
    const bool ended = std::feof(decoder->file_.get()) != 0;
    std::snprintf(decoder->failure_, sizeof decoder->failure_, "%s", ended ? "Read error: hit end of file" : message);
    png_longjmp(png, 1);
  }
  /// An animation has this chunk before its pixels.
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
    stored_bytes_ = uint64_t{png_get_rowbytes(png_, info_)} * png_get_image_height(png_, info_);
    png_set_expand(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool read_rows(png_bytep out) {
    if (setjmp(png_jmpbuf(png_))) return false;
    const size_t row_bytes = png_get_rowbytes(png_, info_);
    const size_t height = png_get_image_height(png_, info_);
    const int passes = png_get_interlace_type(png_, info_) == PNG_INTERLACE_NONE ? 1 : 7;
    for (int pass = 0; pass < passes; ++pass)
      for (size_t y = 0; y < height; ++y) png_read_row(png_, out + y * row_bytes, nullptr);
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
    images_ = {begun_->header()};
  }
  Result<void> read(uint32_t, std::byte* out) override {
    std::unique_ptr<Decoder> decoder = std::move(begun_);
    if (decoder == nullptr) {
      decoder = std::make_unique<Decoder>();
      if (const auto begun = decoder->begin(path_); !begun) return begun;
      if (decoder->header() != header() || decoder->is_deep()) return changed_file();
    }
    return decoder->read(reinterpret_cast<png_bytep>(out));
  }

 private:
  const std::string path_;
  std::unique_ptr<Decoder> begun_;  ///< null once the image has been read
};

}  // namespace

OpenedImage open_png(const std::string& path) {
  auto decoder = std::make_unique<Decoder>();
  if (const auto begun = decoder->begin(path); !begun) return begun.error();
  if (decoder->is_animation()) return std::unique_ptr<ImageFile>();
  if (decoder->is_too_short()) return cut_off();
  if (decoder->is_deep()) return deep_channels("uint16");
  return std::unique_ptr<ImageFile>(std::make_unique<PngImage>(path, std::move(decoder)));
}

}  // namespace tilepress
