// Pixel buffer groups: a group without a twin serves only a probe.
#include "interposer/engine/readback/pixel_buffer_groups.h"

#include <algorithm>
#include <utility>

namespace tilepress {

std::shared_ptr<PixelBuffers> PixelBufferGroups::of_context(const void* own, ReadWay way,
                                                            const GlFunctions& gl, const void* display,
                                                            LateReader& reader, const MakeTwin& make_twin) {
  std::shared_ptr<PixelBuffers> buffers = find(own);
  if (way == ReadWay::kSync) {
    if (buffers != nullptr && buffers->twin() == nullptr) buffers->trim();  // the probe is over
    return nullptr;
  }
  if (buffers == nullptr) {
    buffers = std::make_shared<PixelBuffers>(gl, display);
    if (!PixelBuffers::offered(gl)) buffers->refuse();
    const std::lock_guard lock(mutex_);
    entries_.push_back({own, buffers});
  }
  if (buffers->refused() || (way == ReadWay::kAsync && !reader.accepts())) return nullptr;
  if (way != ReadWay::kAsync || buffers->twin() != nullptr) return buffers;
  TwinContext twin;
  if (make_twin(twin)) {
    buffers->set_twin(std::move(twin));
    if (reader.try_out(buffers)) return buffers;
  }
  buffers->refuse();
  return nullptr;
}

std::shared_ptr<PixelBuffers> PixelBufferGroups::find(const void* context) {
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_)
    if (entry.context == context) return entry.buffers;
  return nullptr;
}

std::shared_ptr<PixelBuffers> PixelBufferGroups::take(const void* context) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.context == context; });
  if (found == entries_.end()) return nullptr;
  std::shared_ptr<PixelBuffers> buffers = std::move(found->buffers);
  entries_.erase(found);
  return buffers;
}

std::vector<std::shared_ptr<PixelBuffers>> PixelBufferGroups::of_display(const void* display) {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<PixelBuffers>> found;
  for (const Entry& entry : entries_)
    if (entry.buffers->display() == display) found.push_back(entry.buffers);
  return found;
}

void trim_later(const std::vector<std::shared_ptr<PixelBuffers>>& groups, LateReader& reader) {
  for (const std::shared_ptr<PixelBuffers>& buffers : groups) {
    if (buffers->twin() == nullptr) continue;
    reader.post(buffers, [buffers](bool entered) {
      if (entered) buffers->trim();
    });
  }
}

}  // namespace tilepress
