// Image frames: the image library for images, plain reads for raw frames.
#include "image_frames.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>

#include "images/image_library.h"
#include "images/plain_png.h"
#include "quiet_standard_error.h"
#include "streams/ending_signals.h"

namespace tilepress {

struct ImageFrames::Source {
  std::string path;
  uint32_t subimage = 0;
  bool raw = false;
};

struct ImageFrames::Reader {
  std::string path;
  std::unique_ptr<ImageFile> input;
};

namespace {

std::string first_line(std::string text) {
  text.erase(std::min(text.find('\n'), text.size()));
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

/// Opens an image with its alpha left as stored.
std::unique_ptr<ImageFile> open_input(const std::string& path, std::string& error) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    error = path + ": " + std::strerror(errno);
    return nullptr;
  }
  if (S_ISDIR(status.st_mode)) {
    error = path + ": is a folder; name its images";
    return nullptr;
  }
  if (auto png = open_plain_png(path)) return png;
  const ImageLibrary* library = image_library(error);
  if (library == nullptr) return nullptr;
  std::string reason;
  auto input = library->open(path, reason);
  if (!input) {
    reason = first_line(reason);
    if (reason.find("could not find a format reader") != std::string::npos) reason = "not an image";
    if (access(path.c_str(), R_OK) != 0) reason = std::strerror(errno);
    error = path + ": " + (reason.empty() ? "not an image" : reason);
  }
  return input;
}

/// The reason why an image cannot be taken as it is, or empty.
std::string refusal(const ImageHeader& image) {
  if (image.sample_type != "uint8")
    return "has " + image.sample_type + " channels; only 8 bits a channel are taken, nothing is narrowed";
  if (image.channels < 1 || image.channels > 4)
    return "has " + std::to_string(image.channels) + " channels, not 1 to 4";
  if (image.volume) return "is a volume";
  return {};
}

/// Whether a JPEG or GIF lacks its end: their readers fill in what is missing without a word.
bool is_torn(const std::string& path, const std::string& format) {
  if (format != "jpeg" && format != "gif") return false;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  const std::streamoff tail_size = std::min<std::streamoff>(size, 4096);
  std::string tail(static_cast<size_t>(std::max<std::streamoff>(tail_size, 0)), '\0');
  file.seekg(size - tail_size);
  if (!file.read(tail.data(), tail_size)) return true;
  // End of image; compressed data never holds these two bytes, and trailing bytes are common.
  if (format == "jpeg") return tail.rfind("\xFF\xD9") == std::string::npos;
  while (!tail.empty() && tail.back() == '\0') tail.pop_back();
  return tail.empty() || tail.back() != ';';
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

/// Reads until `size` bytes or the end; the bytes read, or -1. Gives up once a signal asks the verb to end.
ssize_t read_fully(int fd, std::byte* to, size_t size) {
  size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(fd, to + done, size - done);
    if (got < 0 && errno == EINTR && noted_signal() == 0) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

std::string size_text(FrameSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
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
  if (size.width > kMaxSurfaceSide || size.height > kMaxSurfaceSide) {
    error = name + ": is " + size_text(size) + ", a side is more than " + std::to_string(kMaxSurfaceSide);
    return false;
  }
  if (size_ == FrameSize{}) size_ = size;
  if (size == size_) return true;
  error = name + ": is " + size_text(size) + ", the sequence is " + size_text(size_);
  return false;
}

bool ImageFrames::open_image(const std::string& path, std::string& error) {
  const QuietStandardError quiet;
  const auto input = open_input(path, error);
  if (!input) return false;
  if (is_torn(path, input->kind())) {
    error = path + ": is cut off";
    return false;
  }
  ImageHeader image;
  for (uint32_t subimage = 0; input->header(subimage, image); ++subimage) {
    const std::string name = subimage == 0 ? path : path + " image " + std::to_string(subimage);
    if (const std::string reason = refusal(image); !reason.empty()) {
      error = name + ": " + reason;
      return false;
    }
    if (!accept(name, {image.width, image.height}, error)) return false;
    if (image.channels == 2 || image.channels == 4) format_ = PixelFormat::kRgba8;
    sources_.push_back({path, subimage, false});
  }
  return true;
}

bool ImageFrames::open_raw(const std::string& path, std::string& error) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || access(path.c_str(), R_OK) != 0) {
    error = path + ": " + std::strerror(errno);
    return false;
  }
  const uint64_t wanted = uint64_t{size_.width} * size_.height * 4;
  if (S_ISDIR(status.st_mode) || static_cast<uint64_t>(status.st_size) != wanted) {
    error = path + ": " + std::to_string(status.st_size) + " bytes, a raw frame of " + size_text(size_) +
            " has " + std::to_string(wanted);
    return false;
  }
  format_ = PixelFormat::kRgba8;
  sources_.push_back({path, 0, true});
  return true;
}

bool ImageFrames::open(const std::vector<std::string>& paths, std::optional<FrameSize> raw_size,
                       std::string& error) {
  if (raw_size) size_ = *raw_size;
  for (const std::string& path : paths) {
    if (noted_signal() != 0) return false;
    if (path == "-") {
      if (paths.size() > 1) error = "-: standard input cannot be mixed with files";
      if (!raw_size) error = "-: raw frames on standard input need --size WxH";
      if (!error.empty()) return false;
      streamed_ = true;
      format_ = PixelFormat::kRgba8;
      return true;
    }
    const bool opened = raw_size && path.ends_with(".rgba") ? open_raw(path, error) : open_image(path, error);
    if (!opened) {
      if (!raw_size && path.ends_with(".rgba") && access(path.c_str(), R_OK) == 0)
        error = path + ": a raw frame needs --size WxH";
      return false;
    }
  }
  return true;
}

ImageFrames::Outcome ImageFrames::read_stream(ImageFrame& out, std::string& error) {
  const ssize_t got = read_fully(STDIN_FILENO, out.pixels.data(), out.pixels.size());
  if (got == 0) return Outcome::kEnd;
  if (got == static_cast<ssize_t>(out.pixels.size())) return Outcome::kFrame;
  error = got < 0 ? std::string("-: ") + std::strerror(errno)
                  : "-: the last frame has " + std::to_string(got) + " of " +
                        std::to_string(out.pixels.size()) + " bytes";
  return Outcome::kFailed;
}

ImageFrames::Outcome ImageFrames::read(uint64_t index, ImageFrame& out, std::string& error) {
  const auto begin = std::chrono::steady_clock::now();
  const size_t pixel_count = size_t{size_.width} * size_.height;
  out.pixels.resize(pixel_count * 4);
  Outcome outcome = Outcome::kFrame;
  if (streamed_) {
    outcome = read_stream(out, error);
  } else if (index >= sources_.size()) {
    outcome = Outcome::kEnd;
  } else if (const Source& source = sources_[index]; source.raw) {
    const int fd = ::open(source.path.c_str(), O_RDONLY | O_CLOEXEC);
    const ssize_t got = fd < 0 ? -1 : read_fully(fd, out.pixels.data(), out.pixels.size());
    if (got != static_cast<ssize_t>(out.pixels.size())) {
      error =
          source.path + ": " + (got < 0 ? std::strerror(errno) : "shorter than when it was first looked at");
      outcome = Outcome::kFailed;
    }
    if (fd >= 0) close(fd);
  } else {
    const QuietStandardError quiet;
    // Kept open from frame to frame: seeking in an animation costs decoding what lies before.
    if (!reader_ || reader_->path != source.path) {
      reader_ = std::make_unique<Reader>(Reader{source.path, open_input(source.path, error)});
      if (!reader_->input) return Outcome::kFailed;
    }
    ImageFile& input = *reader_->input;
    ImageHeader image;
    std::string reason;
    const bool same = input.header(source.subimage, image) && refusal(image).empty() &&
                      image.width == size_.width && image.height == size_.height;
    if (!same) {
      error = source.path + ": has changed since it was first looked at";
      outcome = Outcome::kFailed;
    } else if (!input.read(source.subimage, image.channels, out.pixels.data(), reason)) {
      reason = first_line(reason);
      error = source.path + ": " + (reason.empty() ? "cannot be decoded" : reason);
      outcome = Outcome::kFailed;
    } else {
      spread_channels(out.pixels, pixel_count, image.channels);
    }
  }
  out.decode_ns = static_cast<uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin).count());
  return outcome;
}

}  // namespace tilepress
