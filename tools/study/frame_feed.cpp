// Frame feed: the readers of `tilepress frames`, and the frame cache.
#include "frame_feed.h"

#include <memory>

#include "frames/image_frames.h"
#include "study/cache/frame_cache.h"

namespace tilepress {

OpenFeed image_feed(const std::vector<std::string>& paths) {
  struct State {
    ImageFrames frames;
    ImageFrame image;
    uint64_t number = 0;
  };
  return [paths]() -> Result<FrameFeed> {
    const auto state = std::make_shared<State>();
    if (const auto opened = state->frames.open(paths, std::nullopt); !opened) return opened.error();
    return FrameFeed([state](FedFrame& out) {
      const auto read = state->frames.read(state->number, state->image);
      if (read && *read)
        out = {.frame = state->number++,
               .readback_ns = state->image.decode_ns,
               .view = state->frames.view(state->image)};
      return read;
    });
  };
}

OpenFeed cache_feed(const std::string& path) {
  return [path]() -> Result<FrameFeed> {
    const auto reader = std::make_shared<FrameCacheReader>();
    if (const auto opened = reader->open(path); !opened) return opened.error();
    return FrameFeed([reader, number = uint64_t{0}](FedFrame& out) mutable -> Result<bool> {
      if (number == reader->frame_count()) return false;
      const CachedFrame& header = reader->header(number);
      const auto view = reader->view(number++);
      if (!view) return view.error();
      out = {header.frame, header.surface, header.time_ns, header.readback_ns, *view};
      return true;
    });
  };
}

}  // namespace tilepress
