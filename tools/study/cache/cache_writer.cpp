// Cache writer: frames as they come, then the index.
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <optional>

#include "streams/ending_signals.h"
#include "study/cache/cache_format.h"
#include "study/cache/file_bytes.h"
#include "study/cache/frame_codec.h"
#include "study/cache/host_name.h"
#include "tilepress/file_error.h"

namespace tilepress {
namespace {

/// Flushes a new name to the disk. Some file systems cannot; the name is there all the same.
void flush_folder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int fd = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  fsync(fd);
  close(fd);
}

}  // namespace

struct FrameCacheWriter::State {
  struct Surface {
    FrameEncoder encoder;
    CachedFrame last;
  };
  std::string path, work_path;
  int fd = -1;
  uint64_t offset = 0;
  std::vector<CacheEntry> entries;
  std::map<uint32_t, Surface> surfaces;
  std::optional<UnfinishedFile> unfinished;

  ~State() {
    if (fd >= 0) close(fd);
    if (unfinished) unlink(work_path.c_str());
  }
  Result<void> append(std::span<const std::byte> bytes) {
    if (!write_at(fd, offset, bytes)) return file_error(path);
    offset += bytes.size();
    return {};
  }
};

FrameCacheWriter::FrameCacheWriter() : state_(std::make_unique<State>()) {}
FrameCacheWriter::~FrameCacheWriter() = default;

Result<void> FrameCacheWriter::create(const std::string& path) {
  State& state = *state_;
  state.path = path;
  state.work_path = path + ".partial-" + host_name() + "-" + std::to_string(getpid());
  state.unfinished.emplace(state.work_path);
  state.fd = open(state.work_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (state.fd < 0) {
    const Error error = file_error(path);
    state.unfinished.reset();
    return error;
  }
  return state.append(bytes_of(cache_header()));
}

Result<void> FrameCacheWriter::add(const CachedFrame& frame, std::span<const std::byte> pixels) {
  State& state = *state_;
  const auto refuse = [&](const char* why) {
    return Error{ErrorKind::kBadValue, state.path + ": frame " + std::to_string(frame.frame) +
                                           " of surface " + std::to_string(frame.surface) + " " + why};
  };
  if (pixels.size() != frame.pixel_bytes() || pixels.empty()) return refuse("has not the bytes of its size");
  const bool first = !state.surfaces.contains(frame.surface);
  State::Surface& surface = state.surfaces[frame.surface];
  const CachedFrame& last = surface.last;
  if (!first && last.frame >= frame.frame) return refuse("comes after a later frame");
  if (!first && (last.width != frame.width || last.height != frame.height || last.format != frame.format))
    return refuse("has another size or format than the frame before");
  surface.last = frame;
  CacheEntry entry;
  entry.frame = frame;
  const auto stored = surface.encoder.encode(pixels, entry);
  if (!stored) return about(state.path, stored.error());
  entry.offset = state.offset;
  entry.stored_bytes = stored->size();
  entry.stored_hash = hash_of(*stored);
  entry.pixel_hash = wide_hash_of(pixels);
  state.entries.push_back(entry);
  return state.append(*stored);
}

Result<void> FrameCacheWriter::finish(const CacheOrigin& origin) {
  State& state = *state_;
  const std::string tail = cache_tail(origin, state.entries, state.offset);
  if (const auto done = state.append(bytes_of(tail)); !done) return done;
  const bool flushed = fsync(state.fd) == 0;
  const bool closed = close(state.fd) == 0;
  state.fd = -1;
  if (!flushed || !closed || rename(state.work_path.c_str(), state.path.c_str()) != 0)
    return file_error(state.path);
  state.unfinished.reset();
  flush_folder(state.path);
  return {};
}

}  // namespace tilepress
