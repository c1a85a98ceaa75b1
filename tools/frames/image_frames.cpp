// Image frames: the image library for images, plain reads for raw frames.
#include "frames/image_frames.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <set>

#include "images/image_kind.h"
#include "images/image_library.h"
#include "images/png_image.h"
#include "frames/piped_file.h"
#include "streams/quiet_standard_error.h"
#include "streams/ending_signals.h"

namespace tilepress {

/// One image, one raw file, or all frames of a pipe or a sequence.
struct ImageFrames::Source {
  enum class Kind { kImage, kSequence, kRawFile, kRawPipe };
  Kind kind = Kind::kImage;
  std::string name;  ///< as the user gave it
  std::string path;  ///< where the bytes are
  uint32_t subimage = 0;
  std::shared_ptr<Pipe> pipe;  ///< a raw pipe, or the file at `path`
};

struct ImageFrames::Reader {
  std::string path;
  std::unique_ptr<ImageFile> input;
};

namespace {

/// An image takes at most this many pixels: a few bytes can claim more than any memory holds.
constexpr uint64_t kMostImagePixels = uint64_t{1} << 28;
/// Enough of a pipe to know whether it is a movie.
constexpr size_t kMovieStartBytes = 65536;

std::string first_line(std::string text) {
  text.erase(std::min(text.find('\n'), text.size()));
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

/// Opens an image or movie by its content. Null and a reason.
std::unique_ptr<ImageFile> open_input(const std::string& path, std::string& reason) {
  if (image_kind_of_file(path.c_str()).reader == ImageReader::kPng) {
    if (auto png = open_png(path, reason)) return png;
    if (!reason.empty()) return nullptr;
  }
  const ImageLibrary* library = image_library(reason);
  if (library == nullptr) return nullptr;
  auto input = library->open(path, reason);
  reason = first_line(reason);
  if (!input && reason.empty()) reason = "not an image";
  return input;
}

/// The reason why an image cannot be taken as it is, or empty.
std::string refusal(const ImageHeader& image) {
  if (!image.refusal.empty()) return image.refusal;
  if (image.channels < 1 || image.channels > 4)
    return "has " + std::to_string(image.channels) + " channels, not 1 to 4";
  return {};
}

/// Spreads 1 to 4 channels to R,G,B,A in place, from the last pixel backwards. `pixels` has room for 4.
void spread_channels(std::vector<std::byte>& pixels, size_t count, uint32_t channels) {
  if (channels == 4) return;
  const size_t stride = channels;
  for (size_t i = count; i-- > 0;) {
    const std::byte* from = pixels.data() + i * stride;
    const bool gray = channels < 3;
    const std::byte red = from[0], green = from[gray ? 0 : 1], blue = from[gray ? 0 : 2];
    const std::byte alpha = channels == 2 ? from[1] : std::byte{255};
    std::byte* to = pixels.data() + i * 4;
    to[0] = red, to[1] = green, to[2] = blue, to[3] = alpha;
  }
}

std::string size_text(FrameSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// Whether the first bytes of a pipe are an image for certain, so that they are no raw frame.
bool is_surely_image(const std::string& start) {
  const ImageReader reader = image_kind(start).reader;
  return reader == ImageReader::kPng || reader == ImageReader::kGif || reader == ImageReader::kWebp;
}

/// Looks at every path before the first is opened. A pipe can be read once.
bool check_paths(const std::vector<std::string>& paths, std::optional<FrameSize> raw_size,
                 std::string& error) {
  std::set<std::pair<dev_t, ino_t>> pipes;
  for (const std::string& path : paths) {
    struct stat status {};
    const bool standard_input = path == "-";
    if (standard_input && !raw_size)
      error = "-: raw frames on standard input need --size WxH";
    else if (standard_input ? fstat(STDIN_FILENO, &status) != 0
                            : stat(path.c_str(), &status) != 0 || access(path.c_str(), R_OK) != 0)
      error = path + ": " + std::strerror(errno);
    else if (S_ISDIR(status.st_mode))
      error = path + ": is a folder; name its images";
    else if (!raw_size && path.ends_with(".rgba"))
      error = path + ": a raw frame needs --size WxH";
    else if ((standard_input || !S_ISREG(status.st_mode)) &&
             !pipes.insert({status.st_dev, status.st_ino}).second)
      error = path + ": is a pipe that is named twice; it can be read once";
    if (!error.empty()) return false;
  }
  return true;
}

}  // namespace

std::optional<FrameSize> parse_frame_size(const std::string& text) {
  FrameSize size;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, size.width);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != 'x') return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, size.height);
  if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
  const auto fits = [](uint32_t side) { return side >= 1 && side <= kMaxSurfaceSide; };
  return fits(size.width) && fits(size.height) ? std::optional(size) : std::nullopt;
}

ImageFrames::ImageFrames() = default;
ImageFrames::~ImageFrames() = default;
ImageFrames::ImageFrames(ImageFrames&&) noexcept = default;

ImageFrames ImageFrames::another() const {
  ImageFrames out;
  out.sources_ = sources_;
  out.size_ = size_;
  out.format_ = format_;
  return out;
}

std::optional<uint64_t> ImageFrames::count() const {
  return streamed_ ? std::nullopt : std::optional<uint64_t>(sources_.size());
}

bool ImageFrames::accept(const std::string& name, FrameSize size, std::string& error) {
  if (size.width == 0 || size.height == 0 || size.width > kMaxSurfaceSide || size.height > kMaxSurfaceSide)
    error = name + ": is " + size_text(size) + ", a side is not in 1.." + std::to_string(kMaxSurfaceSide);
  else if (uint64_t{size.width} * size.height > kMostImagePixels)
    error = name + ": is " + size_text(size) + ", more than " + std::to_string(kMostImagePixels) + " pixels";
  if (!error.empty()) return false;
  if (size_ == FrameSize{}) size_ = size;
  if (size == size_) return true;
  error = name + ": is " + size_text(size) + ", the sequence is " + size_text(size_);
  return false;
}

bool ImageFrames::open_image(const std::string& name, const std::string& path, std::shared_ptr<Pipe> kept,
                             std::string& error) {
  std::string reason, left_out;
  {
    const QuietStandardError quiet;
    const auto input = open_input(path, reason);
    if (!input) {
      error = name + ": " + reason;
      return false;
    }
    ImageHeader image;
    for (uint32_t subimage = 0; input->header(subimage, image, reason); ++subimage) {
      const std::string one = subimage == 0 ? name : name + " image " + std::to_string(subimage);
      if (const std::string refused = refusal(image); !refused.empty()) {
        error = one + ": " + refused;
        return false;
      }
      if (!accept(one, {image.width, image.height}, error)) return false;
      if (image.channels == 2 || image.channels == 4) format_ = PixelFormat::kRgba8;
      const auto kind = input->is_sequence() ? Source::Kind::kSequence : Source::Kind::kImage;
      sources_.push_back({kind, name, path, subimage, kept});
    }
    if (!reason.empty()) {
      error = name + ": " + reason;
      return false;
    }
    streamed_ = streamed_ || input->is_sequence();
    left_out = input->left_out();
  }
  if (!left_out.empty()) std::fprintf(stderr, "tilepress: %s: %s\n", name.c_str(), left_out.c_str());
  return true;
}

bool ImageFrames::open_raw(const std::string& path, std::string& error) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    error = path + ": " + std::strerror(errno);
    return false;
  }
  const uint64_t wanted = uint64_t{size_.width} * size_.height * 4;
  if (static_cast<uint64_t>(status.st_size) != wanted) {
    error = path + ": " + std::to_string(status.st_size) + " bytes, a raw frame of " + size_text(size_) +
            " has " + std::to_string(wanted);
    return false;
  }
  format_ = PixelFormat::kRgba8;
  sources_.push_back({Source::Kind::kRawFile, path, path, 0, nullptr});
  return true;
}

bool ImageFrames::open_pipe(const std::string& path, bool raw_allowed, std::string& error) {
  std::shared_ptr<Pipe> pipe = Pipe::open(path, error);
  if (!pipe) return false;
  if (raw_allowed && (path == "-" || !is_surely_image(pipe->peek(kImageKindBytes)))) {
    format_ = PixelFormat::kRgba8;
    streamed_ = true;
    sources_.push_back({Source::Kind::kRawPipe, path, path, 0, std::move(pipe)});
    return true;
  }
  const std::string& start = pipe->peek(kMovieStartBytes);
  std::string reason;
  const ImageLibrary* library = image_library(error);
  if (library == nullptr) return false;
  if (image_kind(start).reader == ImageReader::kMovie && !library->may_be_movie(start)) {
    error = path + ": not an image; raw frames need --size WxH too";
    return false;
  }
  const std::shared_ptr<Pipe> copy = copy_to_file(*pipe, reason);
  if (copy) return open_image(path, path_of(*copy), copy, error);
  error = path + ": " + reason;
  return false;
}

bool ImageFrames::open(const std::vector<std::string>& paths, std::optional<FrameSize> raw_size,
                       std::string& error) {
  if (raw_size) size_ = *raw_size;
  if (!check_paths(paths, raw_size, error)) return false;
  for (const std::string& path : paths) {
    if (noted_signal() != 0) return false;
    struct stat status {};
    const bool regular = path != "-" && stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
    const bool raw = raw_size && path.ends_with(".rgba");
    if (!regular ? !open_pipe(path, raw_size.has_value(), error)
        : raw    ? !open_raw(path, error)
                 : !open_image(path, path, nullptr, error))
      return false;
  }
  return true;
}

ImageFrames::Outcome ImageFrames::read_raw(const Source& source, ImageFrame& out, std::string& error) {
  ssize_t got = -1;
  if (source.pipe) {
    got = source.pipe->read(out.pixels.data(), out.pixels.size());
    if (got == 0) return Outcome::kEnd;
  } else if (const int fd = ::open(source.path.c_str(), O_RDONLY | O_CLOEXEC); fd >= 0) {
    got = read_fully(fd, out.pixels.data(), out.pixels.size());
    close(fd);
  }
  if (got == static_cast<ssize_t>(out.pixels.size())) return Outcome::kFrame;
  if (got < 0)
    error = source.name + ": " + std::strerror(errno);
  else if (source.pipe)
    error = source.name + ": the last frame has " + std::to_string(got) + " of " +
            std::to_string(out.pixels.size()) + " bytes";
  else
    error = source.name + ": shorter than when it was first looked at";
  return Outcome::kFailed;
}

ImageFrames::Outcome ImageFrames::read_image(const Source& source, ImageFrame& out, std::string& error) {
  const QuietStandardError quiet;
  std::string reason;
  // Kept open from frame to frame: the frames of a sequence come in order.
  if (!reader_ || reader_->path != source.path) {
    reader_ = std::make_unique<Reader>(Reader{source.path, open_input(source.path, reason)});
    if (!reader_->input) {
      error = source.name + ": " + reason;
      return Outcome::kFailed;
    }
  }
  ImageFile& input = *reader_->input;
  ImageHeader image;
  const bool sequence = source.kind == Source::Kind::kSequence;
  if (!input.header(source.subimage, image, reason) || !refusal(image).empty() ||
      input.is_sequence() != sequence || image.width != size_.width || image.height != size_.height) {
    error = source.name + ": has changed since it was first looked at";
    return Outcome::kFailed;
  }
  if (sequence && input.next(out.pixels.data(), reason)) return Outcome::kFrame;
  if (sequence && reason.empty()) return Outcome::kEnd;
  if (!sequence && input.read(source.subimage, image.channels, out.pixels.data(), reason)) {
    spread_channels(out.pixels, size_t{size_.width} * size_.height, image.channels);
    return Outcome::kFrame;
  }
  reason = first_line(reason);
  error = source.name + ": " + (reason.empty() ? "cannot be decoded" : reason);
  return Outcome::kFailed;
}

ImageFrames::Outcome ImageFrames::read_source(const Source& source, ImageFrame& out, std::string& error) {
  const bool raw = source.kind == Source::Kind::kRawFile || source.kind == Source::Kind::kRawPipe;
  return raw ? read_raw(source, out, error) : read_image(source, out, error);
}

ImageFrames::Outcome ImageFrames::read_next(ImageFrame& out, std::string& error) {
  for (; next_source_ < sources_.size(); ++next_source_) {
    const Source& source = sources_[next_source_];
    const Outcome outcome = read_source(source, out, error);
    if (outcome == Outcome::kEnd) {
      reader_.reset();  // the same file may come again
      continue;
    }
    if (source.kind == Source::Kind::kImage || source.kind == Source::Kind::kRawFile) ++next_source_;
    return outcome;
  }
  return Outcome::kEnd;
}

ImageFrames::Outcome ImageFrames::read(uint64_t index, ImageFrame& out, std::string& error) {
  const auto begin = std::chrono::steady_clock::now();
  Outcome outcome = Outcome::kEnd;
  try {
    out.pixels.resize(size_t{size_.width} * size_.height * 4);
    if (streamed_)
      outcome = read_next(out, error);
    else if (index < sources_.size())
      outcome = read_source(sources_[index], out, error);
  } catch (const std::bad_alloc&) {
    error = size_text(size_) + " pixels: not enough memory";
    outcome = Outcome::kFailed;
  }
  out.decode_ns = static_cast<uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin).count());
  return outcome;
}

}  // namespace tilepress
