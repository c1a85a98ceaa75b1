// Source reader: the image library for images, plain reads for raw frames.
#include "frames/source_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "frames/piped_file.h"
#include "images/image_errors.h"
#include "streams/standard_streams.h"

namespace tilepress {
namespace {

/// Spreads 1 to 4 channels to R,G,B,A in place, from the last pixel backwards. `pixels` has room for 4.
void spread_channels(std::span<std::byte> pixels, uint32_t channels) {
  if (channels == 4) return;
  const bool gray = channels < 3;
  for (size_t i = pixels.size() / 4; i-- > 0;) {
    const std::byte* from = pixels.data() + i * channels;
    const std::byte red = from[0], green = from[gray ? 0 : 1], blue = from[gray ? 0 : 2];
    const std::byte alpha = channels == 2 ? from[1] : std::byte{255};
    std::byte* to = pixels.data() + i * 4;
    to[0] = red, to[1] = green, to[2] = blue, to[3] = alpha;
  }
}

Result<bool> read_raw_file(const std::string& path, std::span<std::byte> out) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return Error{ErrorKind::kFile, std::strerror(errno)};
  const auto got = read_fully(fd, out.data(), out.size());
  close(fd);
  if (!got) return got.error();
  if (*got != out.size()) return Error{ErrorKind::kFile, "shorter than when it was first looked at"};
  return true;
}

Result<bool> read_raw_pipe(Pipe& pipe, std::span<std::byte> out) {
  const auto got = pipe.read(out.data(), out.size());
  if (!got) return got.error();
  if (*got == 0) return false;
  if (*got != out.size())
    return Error{ErrorKind::kFile, "the last frame has " + std::to_string(*got) + " of " +
                                       std::to_string(out.size()) + " bytes"};
  return true;
}

}  // namespace

Result<bool> SourceReader::read(const FrameSource& source, FrameSize size, std::span<std::byte> out) {
  // A cached frame's error names the file already.
  if (source.kind == FrameSource::Kind::kCached) return read_cached(source, out);
  const auto done = source.kind == FrameSource::Kind::kRawFile   ? read_raw_file(source.path, out)
                    : source.kind == FrameSource::Kind::kRawPipe ? read_raw_pipe(*source.pipe, out)
                                                                 : read_image(source, size, out);
  if (!done) return about(source.name, done.error());
  return done;
}

Result<bool> SourceReader::read_cached(const FrameSource& source, std::span<std::byte> out) {
  if (cache_of_ != source.cache) {
    cache_ = source.cache->another();
    cache_of_ = source.cache;
  }
  const auto view = cache_.view(source.image);
  if (!view) return view.error();
  std::memcpy(out.data(), view->top_row, out.size());
  return true;
}

Result<bool> SourceReader::read_image(const FrameSource& source, FrameSize size, std::span<std::byte> out) {
  const QuietStandardError quiet;
  if (file_ == nullptr || path_ != source.path) {
    OpenedImage opened = open_image(source.path);
    if (!opened) return opened.error();
    path_ = source.path;
    file_ = std::move(*opened);
  }
  const bool sequence = source.kind == FrameSource::Kind::kSequence;
  if (source.image >= file_->images().size() || file_->is_sequence() != sequence) return changed_file();
  const ImageHeader& image = file_->images()[source.image];
  if (FrameSize{image.width, image.height} != size) return changed_file();
  if (sequence) return file_->next(out.data());
  if (const auto decoded = file_->read(source.image, out.data()); !decoded) return decoded.error();
  spread_channels(out, image.channels);
  return true;
}

}  // namespace tilepress
