// Cache reader: keeps the last frame of each surface, on which the next one builds.
#include <fcntl.h>
#include <unistd.h>

#include <map>
#include <new>
#include <optional>

#include "study/cache/cache_format.h"
#include "study/cache/file_bytes.h"
#include "study/cache/frame_codec.h"
#include "tilepress/file_error.h"

namespace tilepress {
namespace {

/// The open file and what never changes.
struct OpenCache {
  std::string path;
  int fd = -1;
  CacheIndex index;
  uint64_t raw_bytes = 0;
  std::vector<std::optional<uint64_t>> before;  ///< index of the frame before on the surface

  OpenCache() = default;
  OpenCache(const OpenCache&) = delete;
  OpenCache& operator=(const OpenCache&) = delete;
  ~OpenCache() {
    if (fd >= 0) close(fd);
  }
};

}  // namespace

struct FrameCacheReader::State {
  struct Surface {
    std::vector<std::byte> pixels;
    std::optional<uint64_t> index;  ///< of the frame in `pixels`
  };
  std::shared_ptr<const OpenCache> file;
  FrameDecoder decoder;
  std::vector<std::byte> stored;
  std::map<uint32_t, Surface> surfaces;

  const CacheEntry& entry(uint64_t index) const { return file->index.entries[index]; }

  Error damaged(uint64_t index, const std::string& why) const {
    const CachedFrame& frame = entry(index).frame;
    return {ErrorKind::kBadBits, file->path + ": frame " + std::to_string(frame.frame) + " of surface " +
                                     std::to_string(frame.surface) + ": " + why};
  }

  Result<void> decode(uint64_t index, Surface& surface) {
    const CacheEntry& each = entry(index);
    surface.index.reset();
    if (stored.size() < each.stored_bytes) stored.resize(each.stored_bytes);
    const std::span<std::byte> bytes(stored.data(), each.stored_bytes);
    if (!read_at(file->fd, each.offset, bytes)) return file_error(file->path);
    if (hash_of(bytes) != each.stored_hash) return damaged(index, "is damaged (wrong checksum)");
    surface.pixels.resize(each.frame.pixel_bytes());
    if (const auto done = decoder.decode(each, bytes, surface.pixels); !done)
      return damaged(index, done.error().text);
    surface.index = index;
    return {};
  }

  /// Decodes the frame and those it depends on that are not at hand.
  Result<Surface*> bring(uint64_t index) {
    Surface& surface = surfaces[entry(index).frame.surface];
    std::vector<uint64_t> wanted;
    for (std::optional<uint64_t> at = index; at && at != surface.index; at = file->before[*at]) {
      wanted.push_back(*at);
      if (entry(*at).key) break;
    }
    try {
      for (; !wanted.empty(); wanted.pop_back())
        if (const auto done = decode(wanted.back(), surface); !done) return done.error();
    } catch (const std::bad_alloc&) {
      return Error{ErrorKind::kSystem, file->path + ": not enough memory"};
    }
    return &surface;
  }
};

FrameCacheReader::FrameCacheReader() : state_(std::make_unique<State>()) {}
FrameCacheReader::FrameCacheReader(FrameCacheReader&&) noexcept = default;
FrameCacheReader& FrameCacheReader::operator=(FrameCacheReader&&) noexcept = default;
FrameCacheReader::~FrameCacheReader() = default;

Result<void> FrameCacheReader::open(const std::string& path) {
  auto file = std::make_shared<OpenCache>();
  file->path = path;
  file->fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file->fd < 0) return file_error(path);
  auto index = read_cache_index(file->fd);
  if (!index) return about(path, index.error());
  file->index = std::move(*index);
  std::map<uint32_t, uint64_t> last;
  for (uint64_t i = 0; i < file->index.entries.size(); ++i) {
    const CachedFrame& frame = file->index.entries[i].frame;
    const auto found = last.find(frame.surface);
    file->before.push_back(found == last.end() ? std::nullopt : std::optional(found->second));
    last[frame.surface] = i;
    file->raw_bytes += frame.pixel_bytes();
  }
  state_ = std::make_unique<State>();
  state_->file = std::move(file);
  return {};
}

FrameCacheReader FrameCacheReader::another() const {
  FrameCacheReader out;
  out.state_->file = state_->file;
  return out;
}

const CacheOrigin& FrameCacheReader::origin() const {
  return state_->file->index.origin;
}
uint64_t FrameCacheReader::frame_count() const {
  return state_->file->index.entries.size();
}
const CachedFrame& FrameCacheReader::header(uint64_t index) const {
  return state_->entry(index).frame;
}
const std::string& FrameCacheReader::frames_digest() const {
  return state_->file->index.frames_digest;
}
uint64_t FrameCacheReader::raw_bytes() const {
  return state_->file->raw_bytes;
}

Result<SurfaceView> FrameCacheReader::view(uint64_t index) {
  const auto surface = state_->bring(index);
  if (!surface) return surface.error();
  const CachedFrame& frame = header(index);
  return SurfaceView{.top_row = (*surface)->pixels.data(),
                     .pitch_bytes = static_cast<ptrdiff_t>(frame.pitch_bytes()),
                     .width = frame.width,
                     .height = frame.height,
                     .format = frame.format,
                     .order = ByteOrder::kNative};
}

Result<void> FrameCacheReader::read(uint64_t index, std::vector<std::byte>& pixels) {
  const auto surface = state_->bring(index);
  if (!surface) return surface.error();
  pixels.assign((*surface)->pixels.begin(), (*surface)->pixels.end());
  return {};
}

}  // namespace tilepress
