// GIF image: giflib decodes the parts, this file composes them.
#include "images/gif_image.h"

#include <gif_lib.h>

#include <cstring>
#include <vector>

namespace tilepress {
namespace {

constexpr size_t kPixelBytes = 4;

struct CloseGif {
  void operator()(GifFileType* gif) const { DGifCloseFile(gif, nullptr); }
};

/// A GIF read from its beginning, part by part.
class GifReader {
 public:
  bool begin(const std::string& path, std::string& reason) {
    int error = 0;
    gif_.reset(DGifOpenFileName(path.c_str(), &error));
    if (!gif_) reason = reason_of(error);
    return gif_ != nullptr;
  }
  uint32_t width() const { return static_cast<uint32_t>(gif_->SWidth); }
  uint32_t height() const { return static_cast<uint32_t>(gif_->SHeight); }
  const GifImageDesc& part() const { return gif_->Image; }
  const GraphicsControlBlock& control() const { return control_; }
  const ColorMapObject* colors() const { return part().ColorMap ? part().ColorMap : gif_->SColorMap; }

  /// Goes to the next part's pixels. False: the end, or a reason.
  bool find_part(std::string& reason) {
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
      if (!is_inside())
        reason = "has a part that lies outside of its screen";
      else if (colors() == nullptr)
        reason = "has a part without a palette";
      return reason.empty();
    }
    reason = reason_of(gif_->Error);
    return false;
  }
  bool skip_pixels(std::string& reason) {
    int code_size = 0;
    GifByteType* block = nullptr;
    bool good = DGifGetCode(gif_.get(), &code_size, &block) == GIF_OK;
    while (good && block != nullptr) good = DGifGetCodeNext(gif_.get(), &block) == GIF_OK;
    if (!good) reason = reason_of(gif_->Error);
    return good;
  }
  /// Draws the part onto a canvas of the screen's size.
  bool draw(std::byte* canvas, std::string& reason) {
    std::vector<GifPixelType> row(static_cast<size_t>(part().Width));
    constexpr int kPasses[4][2] = {{0, 8}, {4, 8}, {2, 4}, {1, 2}};  // of an interlaced part: first row, step
    for (int pass = 0; pass < (part().Interlace ? 4 : 1); ++pass)
      for (int y = part().Interlace ? kPasses[pass][0] : 0; y < part().Height;
           y += part().Interlace ? kPasses[pass][1] : 1) {
        if (DGifGetLine(gif_.get(), row.data(), part().Width) != GIF_OK) {
          reason = reason_of(gif_->Error);
          return false;
        }
        if (!draw_row(row, canvas + (size_t(part().Top + y) * width() + size_t(part().Left)) * kPixelBytes)) {
          reason = "has a colour that its palette lacks";
          return false;
        }
      }
    return true;
  }

 private:
  static std::string reason_of(int error) {
    if (error == D_GIF_ERR_READ_FAILED || error == D_GIF_ERR_EOF_TOO_SOON) return "is cut off";
    const char* text = GifErrorString(error);
    return text != nullptr ? std::string("is damaged: ") + text : "is damaged";
  }
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
  bool open(const std::string& path, std::string& reason) {
    path_ = path;
    GifReader reader;
    if (!reader.begin(path, reason)) return false;
    header_ = {.width = reader.width(), .height = reader.height(), .channels = kPixelBytes};
    uint64_t count = 0;
    while (reader.find_part(reason) && reader.skip_pixels(reason)) ++count;
    if (reason.empty() && count == 0) reason = "has no image";
    animated_ = count > 1;
    return reason.empty();
  }
  bool header(uint32_t image, ImageHeader& out, std::string&) override {
    if (image == 0) out = header_;
    return image == 0;
  }
  bool is_sequence() const override { return animated_; }

  bool read(uint32_t, uint32_t, std::byte* out, std::string& reason) override {
    GifReader reader;
    std::memset(out, 0, canvas_bytes());
    return reader.begin(path_, reason) && is_same(reader) && reader.find_part(reason) &&
           reader.draw(out, reason);
  }
  bool next(std::byte* out, std::string& reason) override {
    if (canvas_.empty()) {
      if (!reader_.begin(path_, reason) || !is_same(reader_)) return false;
      canvas_.resize(canvas_bytes());
    } else {
      dispose();
    }
    if (!reader_.find_part(reason)) return false;
    disposal_ = reader_.control().DisposalMode;
    part_ = reader_.part();
    if (disposal_ == DISPOSE_PREVIOUS) before_ = canvas_;
    if (!reader_.draw(canvas_.data(), reason)) return false;
    std::memcpy(out, canvas_.data(), canvas_.size());
    return true;
  }

 private:
  size_t canvas_bytes() const { return size_t{header_.width} * header_.height * kPixelBytes; }
  bool is_same(const GifReader& reader) const {
    return reader.width() == header_.width && reader.height() == header_.height;
  }
  void dispose() {
    if (disposal_ == DISPOSE_PREVIOUS) canvas_.swap(before_);
    if (disposal_ != DISPOSE_BACKGROUND) return;
    for (int y = part_.Top; y < part_.Top + part_.Height; ++y)
      std::memset(&canvas_[(size_t(y) * header_.width + size_t(part_.Left)) * kPixelBytes], 0,
                  size_t(part_.Width) * kPixelBytes);
  }

  std::string path_;
  ImageHeader header_;
  bool animated_ = false;
  GifReader reader_;
  std::vector<std::byte> canvas_;  ///< empty before the first frame
  std::vector<std::byte> before_;  ///< the canvas before the part, for DISPOSE_PREVIOUS
  int disposal_ = DISPOSAL_UNSPECIFIED;
  GifImageDesc part_ = {};  ///< the place of the part drawn last
};

}  // namespace

std::unique_ptr<ImageFile> open_gif(const std::string& path, std::string& reason) {
  auto gif = std::make_unique<GifImage>();
  if (!gif->open(path, reason)) return nullptr;
  return gif;
}

}  // namespace tilepress
