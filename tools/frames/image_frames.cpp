// Image frames: a source per frame, or streams one after the other.
#include "frames/image_frames.h"

#include <new>

#include "frames/stop_watch.h"

namespace tilepress {

Result<void> ImageFrames::open(const std::vector<std::string>& paths, std::optional<FrameSize> raw_size,
                               PixelFormat raw_format) {
  auto found = find_frame_sources(paths, raw_size, raw_format);
  if (!found) return found.error();
  sources_ = std::move(*found);
  return {};
}

ImageFrames ImageFrames::another() const {
  ImageFrames out;
  out.sources_ = sources_;
  return out;
}

std::optional<uint64_t> ImageFrames::count() const {
  return streamed() ? std::nullopt : std::optional<uint64_t>(sources_.list.size());
}

Result<bool> ImageFrames::read_next(ImageFrame& out) {
  for (; next_source_ < sources_.list.size(); ++next_source_) {
    const FrameSource& source = sources_.list[next_source_];
    const auto done = reader_.read(source, size(), out.pixels);
    if (done && !*done) {
      reader_.close();  // the same file may come again
      continue;
    }
    if (!source.is_stream()) ++next_source_;
    return done;
  }
  return false;
}

Result<bool> ImageFrames::read(uint64_t index, ImageFrame& out) {
  const StopWatch clock;
  const auto decode = [&]() -> Result<bool> {
    try {
      out.pixels.resize(sources_.frame_bytes());
      if (streamed()) return read_next(out);
      if (index >= sources_.list.size()) return false;
      return reader_.read(sources_.list[index], size(), out.pixels);
    } catch (const std::bad_alloc&) {
      return Error{ErrorKind::kSystem, size().text() + " pixels: not enough memory"};
    }
  };
  auto done = decode();
  out.decode_ns = clock.nanoseconds();
  return done;
}

SurfaceView ImageFrames::view(const ImageFrame& frame) const {
  return {.top_row = frame.pixels.data(),
          .pitch_bytes = static_cast<ptrdiff_t>(size().width * (traits(format()).pixel_bits / 8)),
          .width = size().width,
          .height = size().height,
          .format = format(),
          .order = ByteOrder::kNative};
}

}  // namespace tilepress
