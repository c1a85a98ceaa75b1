// Frame sources: stat() for all paths first, then headers.
#include "frames/frame_sources.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>

#include "frames/cached_surface.h"
#include "frames/image_folders.h"
#include "frames/piped_file.h"
#include "images/image_kind.h"
#include "images/image_library.h"
#include "input_kind.h"
#include "streams/ending_signals.h"
#include "streams/messages.h"
#include "streams/standard_streams.h"
#include "way_out.h"

namespace tilepress {
namespace {

/// A few bytes of a file can claim more pixels than any memory holds.
constexpr uint64_t kMostImagePixels = uint64_t{1} << 28;
/// Enough of a pipe to know whether it is a movie.
constexpr size_t kMovieStartBytes = 65536;

/// Whether the first bytes of a pipe are certainly an image and no raw frame.
bool is_surely_image(const std::string& start) {
  const ImageReader reader = image_kind(start).reader;
  return reader == ImageReader::kPng || reader == ImageReader::kGif || reader == ImageReader::kWebp;
}

class SourceFinder {
 public:
  SourceFinder(std::optional<FrameSize> raw_size, PixelFormat raw_format)
      : takes_raw_(raw_size.has_value()), raw_format_(raw_format) {
    found_.size = raw_size.value_or(FrameSize{});
  }

  Result<FrameSources> find(const std::vector<std::string>& given) {
    const auto expanded = expand_image_folders(given, [this](const std::string& path) { return is_raw(path); });
    if (!expanded) return expanded.error();
    const std::vector<std::string>& paths = *expanded;
    for (const std::string& path : paths)
      if (const auto checked = check_path(path); !checked) return checked.error();
    for (const std::string& path : paths) {
      if (const int signal = noted_signal(); signal != 0)
        return Error{ErrorKind::kSystem, signal_text(signal)};
      struct stat status {};
      const bool regular = path != "-" && stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
      const auto added = !regular       ? add_pipe(path)
                         : is_raw(path) ? add_raw_file(path)
                                        : add_image_file(path, path, nullptr);
      if (!added)
        return Error{added.error().kind, path + ": " + added.error().text + verb_hint(path, "frames")};
    }
    return std::move(found_);
  }

 private:
  bool all_raw() const { return takes_raw_ && raw_format_ != PixelFormat::kRgba8; }
  bool is_raw(const std::string& path) const { return all_raw() || (takes_raw_ && path.ends_with(".rgba")); }

  /// Looks at a path before any file is opened: a pipe can be read only once.
  Result<void> check_path(const std::string& path) {
    const bool standard_input = path == "-";
    if (standard_input && !takes_raw_)
      return Error{ErrorKind::kBadValue, path + ": raw frames on standard input need --size WxH"};
    struct stat status {};
    if (standard_input ? fstat(STDIN_FILENO, &status) != 0
                       : stat(path.c_str(), &status) != 0 || access(path.c_str(), R_OK) != 0)
      return Error{ErrorKind::kFile, errno == ENOENT ? missing_text(path) : path + ": " + std::strerror(errno)};
    if (!takes_raw_ && path.ends_with(".rgba"))
      return Error{ErrorKind::kBadValue, path + ": a raw frame needs --size WxH"};
    const bool pipe = standard_input || !S_ISREG(status.st_mode);
    if (pipe && !pipes_.insert({status.st_dev, status.st_ino}).second)
      return Error{ErrorKind::kFile, path + ": is a pipe that is named twice; it can be read once"};
    return {};
  }

  Result<void> accept_size(const ImageHeader& image) {
    const FrameSize size{image.width, image.height};
    const auto refuse = [&](const std::string& why) {
      return Error{ErrorKind::kUnsupported, "is " + size.text() + ", " + why};
    };
    if (!size.is_possible()) return refuse("a side is not in 1.." + std::to_string(kMaxSurfaceSide));
    if (size.pixels() > kMostImagePixels)
      return refuse("more than " + std::to_string(kMostImagePixels) + " pixels");
    if (found_.size == FrameSize{}) found_.size = size;
    if (size != found_.size) return refuse("the sequence is " + found_.size.text());
    return {};
  }

  Result<void> accept(const ImageHeader& image) {
    if (const auto accepted = accept_size(image); !accepted) return accepted;
    return accept(image.channels == 2 || image.channels == 4 ? PixelFormat::kRgba8 : PixelFormat::kRgbx8);
  }

  Result<void> accept(PixelFormat format) {
    const auto is_of_images = [](PixelFormat each) {
      return each == PixelFormat::kRgba8 || each == PixelFormat::kRgbx8;
    };
    if (found_.list.empty()) found_.format = format;
    if (is_of_images(format) && is_of_images(found_.format)) {
      if (format == PixelFormat::kRgba8) found_.format = format;
    } else if (format != found_.format) {
      return Error{ErrorKind::kUnsupported, "is " + std::string(traits(format).name) + ", the sequence is " +
                                                std::string(traits(found_.format).name)};
    }
    return {};
  }

  Result<void> add_cached_frames(const std::string& name, const std::string& path,
                                 const std::shared_ptr<Pipe>& kept) {
    const auto surface = largest_cached_surface(path);
    if (!surface) return surface.error();
    const ImageHeader image{surface->width, surface->height, 3};
    if (const auto accepted = accept_size(image); !accepted) return accepted;
    if (const auto accepted = accept(surface->format); !accepted) return accepted;
    for (const uint32_t index : surface->frames)
      add({FrameSource::Kind::kCached, name, path, index, kept, surface->cache});
    if (!surface->left_out.empty()) say(MessageLevel::kWarning, name + ": " + surface->left_out);
    return {};
  }

  /// `kept` keeps the file at `path` open.
  Result<void> add_image_file(const std::string& name, const std::string& path, std::shared_ptr<Pipe> kept) {
    if (is_frame_cache(path)) return add_cached_frames(name, path, kept);
    std::string left_out;
    {
      const QuietStandardError quiet;
      const OpenedImage opened = open_image(path);
      if (!opened) return opened.error();
      const ImageFile& file = **opened;
      for (uint32_t image = 0; image < file.images().size(); ++image) {
        if (const auto accepted = accept(file.images()[image]); !accepted)
          return image == 0 ? accepted.error() : about("image " + std::to_string(image), accepted.error());
        const auto kind = file.is_sequence() ? FrameSource::Kind::kSequence : FrameSource::Kind::kImage;
        add({kind, name, path, image, kept, nullptr});
      }
      left_out = file.left_out();
    }
    if (!left_out.empty()) say(MessageLevel::kWarning, name + ": " + left_out);
    return {};
  }

  Result<void> add_raw_file(const std::string& path) {
    found_.format = raw_format_;
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return Error{ErrorKind::kFile, std::strerror(errno)};
    if (static_cast<uint64_t>(status.st_size) != found_.frame_bytes())
      return Error{ErrorKind::kFile, std::to_string(status.st_size) + " bytes, a raw frame of " +
                                         found_.size.text() + " has " + std::to_string(found_.frame_bytes())};
    add({FrameSource::Kind::kRawFile, path, path, 0, nullptr, nullptr});
    return {};
  }

  Result<void> add_pipe(const std::string& path) {
    const auto opened = Pipe::open(path);
    if (!opened) return opened.error();
    const std::shared_ptr<Pipe> pipe = *opened;
    if (all_raw() || (takes_raw_ && (path == "-" || !is_surely_image(pipe->peek(kImageKindBytes))))) {
      found_.format = raw_format_;
      add({FrameSource::Kind::kRawPipe, path, path, 0, pipe, nullptr});
      return {};
    }
    const std::string& start = pipe->peek(kMovieStartBytes);
    const auto library = image_library();
    if (!library) return library.error();
    if (image_kind(start).reader == ImageReader::kMovie && !(*library)->may_be_movie(start))
      return Error{ErrorKind::kUnsupported, "not an image; raw frames need --size WxH too"};
    const auto copy = copy_to_file(*pipe);
    if (!copy) return copy.error();
    return add_image_file(path, (*copy)->path(), *copy);
  }

  void add(FrameSource source) {
    found_.streamed |= source.is_stream();
    found_.list.push_back(std::move(source));
  }

  const bool takes_raw_;
  const PixelFormat raw_format_;
  std::set<std::pair<dev_t, ino_t>> pipes_;
  FrameSources found_;
};

}  // namespace

Result<FrameSources> find_frame_sources(const std::vector<std::string>& paths,
                                        std::optional<FrameSize> raw_size, PixelFormat raw_format) {
  return SourceFinder(raw_size, raw_format).find(paths);
}

}  // namespace tilepress
