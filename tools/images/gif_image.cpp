// GIF image: giflib decodes the parts, this file composes them.
#include "images/image_readers.h"

#include <gif_lib.h>

#include <cstring>
#include <vector>

#include "images/image_errors.h"

namespace tilepress {
namespace {

constexpr size_t kPixelBytes = 4;

struct CloseGif {
  void operator()(GifFileType* gif) const { DGifCloseFile(gif, nullptr); }
};

/// A GIF read from its beginning, part by part.
class GifReader {
 public:
  Result<void> begin(const std::string& path) {
    int error = 0;
    gif_.reset(DGifOpenFileName(path.c_str(), &error));
    if (!gif_) return error_of(error);
    return {};
  }
  uint32_t width() const { return static_cast<uint32_t>(gif_->SWidth); }
  uint32_t height() const { return static_cast<uint32_t>(gif_->SHeight); }
  const GifImageDesc& part() const { return gif_->Image; }
  const GraphicsControlBlock& control() const { return control_; }

  /// Goes to the pixels of the next part. Returns false after the last part.
  Result<bool> find_part() {
    control_ = {.DisposalMode = DISPOSAL_UNSPECIFIED,
                .UserInputFlag = false,
                .DelayTime = 0,
                .TransparentColor = NO_TRANSPARENT_COLOR};
    GifRecordType type;
    while (DGifGetRecordType(gif_.get(), &type) == GIF_OK) {
      if (type == TERMINATE_RECORD_TYPE) return false;
      if (type == EXTENSION_RECORD_TYPE && !read_extension()) break;
      if (type != IMAGE_DESC_RECORD_TYPE) continue;
      if (DGifGetImageDesc(gif_.get()) != GIF_OK) break;
      if (!is_inside()) return Error{ErrorKind::kFile, "has a part that lies outside of its screen"};
      if (colors() == nullptr) return Error{ErrorKind::kFile, "has a part without a palette"};
      return true;
    }
    return error_of(gif_->Error);
  }
  Result<void> skip_pixels() {
    int code_size = 0;
    GifByteType* block = nullptr;
    bool good = DGifGetCode(gif_.get(), &code_size, &block) == GIF_OK;
    while (good && block != nullptr) good = DGifGetCodeNext(gif_.get(), &block) == GIF_OK;
    if (!good) return error_of(gif_->Error);
    return {};
  }
  /// Draws the part onto a canvas of the screen's size.
  Result<void> draw(std::byte* canvas) {
    std::vector<GifPixelType> row(static_cast<size_t>(part().Width));
    constexpr int kPasses[4][2] = {{0, 8}, {4, 8}, {2, 4}, {1, 2}};  // of an interlaced part: first row, step
    for (int pass = 0; pass < (part().Interlace ? 4 : 1); ++pass)
      for (int y = part().Interlace ? kPasses[pass][0] : 0; y < part().Height;
           y += part().Interlace ? kPasses[pass][1] : 1) {
        if (DGifGetLine(gif_.get(), row.data(), part().Width) != GIF_OK) return error_of(gif_->Error);
        std::byte* to = canvas + (size_t(part().Top + y) * width() + size_t(part().Left)) * kPixelBytes;
        if (!draw_row(row, to)) return Error{ErrorKind::kFile, "has a colour that its palette lacks"};
      }
    return {};
  }

 private:
  static Error error_of(int code) {
    if (code == D_GIF_ERR_READ_FAILED || code == D_GIF_ERR_EOF_TOO_SOON) return cut_off();
    const char* text = GifErrorString(code);
    return {ErrorKind::kFile, text != nullptr ? std::string("is damaged: ") + text : "is damaged"};
  }
  const ColorMapObject* colors() const { return part().ColorMap ? part().ColorMap : gif_->SColorMap; }
  bool is_inside() const {
    return part().Left >= 0 && part().Top >= 0 && part().Width > 0 && part().Height > 0 &&
           part().Left + part().Width <= gif_->SWidth && part().Top + part().Height <= gif_->SHeight;
  }
  bool read_extension() {
    int code = 0;
    GifByteType* block = nullptr;
    bool good = DGifGetExtension(gif_.get(), &code, &block) == GIF_OK;
    if (good && block != nullptr && code == GRAPHICS_EXT_FUNC_CODE) {
      DGifExtensionToGCB(block[0], block + 1, &control_);
      if (control_.DisposalMode == 4) control_.DisposalMode = DISPOSE_PREVIOUS;  // as some encoders write it
    }
    while (good && block != nullptr) good = DGifGetExtensionNext(gif_.get(), &block) == GIF_OK;
    return good;
  }
  bool draw_row(const std::vector<GifPixelType>& row, std::byte* to) const {
    for (const GifPixelType index : row) {
      if (index != control_.TransparentColor) {
        if (index >= colors()->ColorCount) return false;
        const GifColorType& color = colors()->Colors[index];
        to[0] = std::byte{color.Red}, to[1] = std::byte{color.Green}, to[2] = std::byte{color.Blue};
        to[3] = std::byte{255};
      }
      to += kPixelBytes;
    }
    return true;
  }

  std::unique_ptr<GifFileType, CloseGif> gif_;
  GraphicsControlBlock control_ = {};
};

class GifImage final : public ImageFile {
 public:
  Result<void> open(const std::string& path) {
    path_ = path;
    GifReader reader;
    if (const auto begun = reader.begin(path); !begun) return begun;
    images_ = {{reader.width(), reader.height(), kPixelBytes}};
    for (uint64_t count = 0;; ++count) {
      const auto part = reader.find_part();
      if (!part) return part.error();
      if (!*part && count == 0) return Error{ErrorKind::kFile, "has no image"};
      if (!*part) return {};
      if (const auto skipped = reader.skip_pixels(); !skipped) return skipped;
      sequence_ = count > 0;
    }
  }

  Result<void> read(uint32_t, std::byte* out) override {
    GifReader reader;
    std::memset(out, 0, canvas_bytes());
    if (const auto begun = begin(reader); !begun) return begun;
    const auto part = reader.find_part();
    if (!part) return part.error();
    if (!*part) return changed_file();
    return reader.draw(out);
  }

  Result<bool> next(std::byte* out) override {
    if (canvas_.empty()) {
      if (const auto begun = begin(reader_); !begun) return begun.error();
      canvas_.resize(canvas_bytes());
    } else {
      dispose();
    }
    const auto part = reader_.find_part();
    if (!part || !*part) return part;
    disposal_ = reader_.control().DisposalMode;
    part_ = reader_.part();
    if (disposal_ == DISPOSE_PREVIOUS) before_ = canvas_;
    if (const auto drawn = reader_.draw(canvas_.data()); !drawn) return drawn.error();
    std::memcpy(out, canvas_.data(), canvas_.size());
    return true;
  }

 private:
  size_t canvas_bytes() const { return size_t{header().width} * header().height * kPixelBytes; }
  Result<void> begin(GifReader& reader) const {
    const auto begun = reader.begin(path_);
    if (begun && (reader.width() != header().width || reader.height() != header().height)) return changed_file();
    return begun;
  }
  void dispose() {
    if (disposal_ == DISPOSE_PREVIOUS) canvas_.swap(before_);
    if (disposal_ != DISPOSE_BACKGROUND) return;
    for (int y = part_.Top; y < part_.Top + part_.Height; ++y)
      std::memset(&canvas_[(size_t(y) * header().width + size_t(part_.Left)) * kPixelBytes], 0,
                  size_t(part_.Width) * kPixelBytes);
  }

  std::string path_;
  GifReader reader_;
  std::vector<std::byte> canvas_;  ///< empty before the first frame
  std::vector<std::byte> before_;  ///< the canvas before the part, for DISPOSE_PREVIOUS
  int disposal_ = DISPOSAL_UNSPECIFIED;
  GifImageDesc part_ = {};  ///< the place of the part drawn last
};

}  // namespace

OpenedImage open_gif(const std::string& path) {
  return open_with<GifImage>(path);
}

}  // namespace tilepress
