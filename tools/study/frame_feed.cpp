// Frame feed: the readers of `tilepress frames`, and the frame cache.
#include "frame_feed.h"

#include "frames/image_frames.h"
#include "study/cache/frame_cache.h"

namespace tilepress {
namespace {

class ImageFeed : public FrameFeed {
 public:
  Result<void> open(const std::vector<std::string>& paths) { return images_.open(paths, std::nullopt); }
  Result<bool> next(FedFrame& out) override {
    const auto read = images_.read(number_, image_);
    if (!read || !*read) return read;
    out = {.frame = number_++, .readback_ns = image_.decode_ns, .view = images_.view(image_)};
    return true;
  }

 private:
  ImageFrames images_;
  ImageFrame image_;
  uint64_t number_ = 0;
};

class CacheFeed : public FrameFeed {
 public:
  Result<void> open(const std::string& path) { return reader_.open(path); }
  Result<bool> next(FedFrame& out) override {
    if (number_ == reader_.frame_count()) return false;
    const CachedFrame& header = reader_.header(number_);
    const auto view = reader_.view(number_++);
    if (!view) return view.error();
    out = {header.frame, header.surface, header.time_ns, header.readback_ns, *view};
    return true;
  }

 private:
  FrameCacheReader reader_;
  uint64_t number_ = 0;
};

template <class Feed, class Source>
OpenFeed opener(const Source& source) {
  return [source]() -> Result<std::unique_ptr<FrameFeed>> {
    auto feed = std::make_unique<Feed>();
    if (const auto opened = feed->open(source); !opened) return opened.error();
    return std::unique_ptr<FrameFeed>(std::move(feed));
  };
}

}  // namespace

OpenFeed image_feed(const std::vector<std::string>& paths) {
  return opener<ImageFeed>(paths);
}

OpenFeed cache_feed(const std::string& path) {
  return opener<CacheFeed>(path);
}

}  // namespace tilepress
