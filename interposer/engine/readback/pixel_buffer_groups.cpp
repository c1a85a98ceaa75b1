// Pixel buffer groups: a group without a twin serves only a probe.
#include "interposer/engine/readback/pixel_buffer_groups.h"

#include <utility>

namespace tilepress {

std::shared_ptr<PixelBuffers> PixelBufferGroups::of_context(const void* own, ReadWay way,
                                                            const GlFunctions& gl, const void* display,
                                                            LateReader& reader, const MakeTwin& make_twin) {
  std::unique_lock lock(mutex_);
  const auto known = groups_.find(own);
  std::shared_ptr<PixelBuffers> buffers = known != groups_.end() ? known->second : nullptr;
  lock.unlock();
  if (way == ReadWay::kSync) {
    if (buffers != nullptr && buffers->twin() == nullptr) buffers->trim();  // the probe is over
    return nullptr;
  }
  if (buffers == nullptr) {
    buffers = std::make_shared<PixelBuffers>(gl, display);
    if (!PixelBuffers::offered(gl)) buffers->refuse();
    lock.lock();
    groups_[own] = buffers;
    lock.unlock();
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

std::shared_ptr<PixelBuffers> PixelBufferGroups::take(const void* context) {
  const std::lock_guard lock(mutex_);
  auto taken = groups_.extract(context);
  return taken ? std::move(taken.mapped()) : nullptr;
}

std::vector<std::shared_ptr<PixelBuffers>> PixelBufferGroups::of_display(const void* display) {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<PixelBuffers>> found;
  for (const auto& [context, buffers] : groups_)
    if (buffers->display() == display) found.push_back(buffers);
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
