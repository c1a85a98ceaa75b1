// Pixel buffers: a few buffer objects in turn. A new one for each frame would cost the driver more than the
// read.
#include "interposer/engine/readback/pixel_buffers.h"

#include <GL/glext.h>

#include <cstring>

#include "interposer/engine/source/context_version.h"
#include "interposer/system_calls.h"

namespace tilepress {

constexpr uint64_t kSliceNs = 100'000'000;
constexpr int kSlices = 100;  // after ten seconds the graphics processor counts as hung

static bool has_extension(const GlFunctions& gl, const char* name) {
  const auto* all = reinterpret_cast<const char*>(gl.GetString(GL_EXTENSIONS));
  const bool found = all != nullptr && strstr(all, name) != nullptr;
  gl.clear_errors();  // core profiles do not have the string
  return found;
}

bool PixelBuffers::offered(const GlFunctions& gl) {
  const bool complete = gl.GenBuffers != nullptr && gl.DeleteBuffers != nullptr && gl.BindBuffer != nullptr &&
                        gl.BufferData != nullptr && gl.MapBufferRange != nullptr &&
                        gl.UnmapBuffer != nullptr && gl.FenceSync != nullptr &&
                        gl.ClientWaitSync != nullptr && gl.DeleteSync != nullptr && gl.Flush != nullptr;
  const ContextVersion version = version_of(gl);
  if (!complete || version.number < 30) return false;
  return version.embedded || version.number >= 32 || has_extension(gl, "GL_ARB_sync");
}

PixelBuffers::Buffer PixelBuffers::acquire(size_t bytes) {
  Buffer buffer{0, 0};
  {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      buffer = free_.back();
      free_.pop_back();
    }
  }
  if (buffer.name == 0) gl_.GenBuffers(1, &buffer.name);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer.name);
  if (buffer.bytes != bytes)
    gl_.BufferData(GL_PIXEL_PACK_BUFFER, static_cast<ptrdiff_t>(bytes), nullptr, GL_STREAM_READ);
  buffer.bytes = bytes;
  return buffer;
}

std::unique_ptr<LateRead> PixelBuffers::begin(const Area& area, uint64_t& took_ns) {
  const Buffer buffer = acquire(area.bytes);
  const uint64_t begin_ns = now_ns();
  gl_.ReadPixels(0, 0, area.width, area.height, area.format, area.type, nullptr);
  void* fence = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl_.Flush();
  took_ns = now_ns() - begin_ns;
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  bool failed = fence == nullptr;
  while (gl_.GetError() != GL_NO_ERROR) failed = true;
  if (!failed)
    return std::make_unique<LateRead>(LateRead{shared_from_this(), buffer.name, fence, area.bytes});
  if (fence != nullptr) gl_.DeleteSync(fence);
  gl_.DeleteBuffers(1, &buffer.name);
  refuse();
  return nullptr;
}

bool PixelBuffers::wait(void* fence) const {
  for (int slice = 0; slice < kSlices; ++slice) {
    const GLenum state = gl_.ClientWaitSync(fence, 0, kSliceNs);
    if (state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED) return true;
    if (state != GL_TIMEOUT_EXPIRED) return false;
  }
  return false;
}

template <typename Use>
bool PixelBuffers::use(LateRead& read, const Use& use) {
  bool whole = wait(read.fence);
  gl_.DeleteSync(read.fence);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, read.buffer);
  const void* pixels = nullptr;
  if (whole)
    pixels = gl_.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, static_cast<ptrdiff_t>(read.bytes), GL_MAP_READ_BIT);
  whole = pixels != nullptr && use(static_cast<const std::byte*>(pixels));
  if (pixels != nullptr && gl_.UnmapBuffer(GL_PIXEL_PACK_BUFFER) == GL_FALSE) whole = false;
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  while (gl_.GetError() != GL_NO_ERROR) whole = false;
  if (!whole) refuse();
  const std::lock_guard lock(mutex_);
  free_.push_back({read.buffer, read.bytes});
  return whole;
}

bool PixelBuffers::take(LateRead& read, std::byte* out) {
  return use(read, [&](const std::byte* pixels) {
    memcpy(out, pixels, read.bytes);
    return true;
  });
}

bool PixelBuffers::equals(LateRead& read, const std::byte* other) {
  return use(read, [&](const std::byte* pixels) { return memcmp(other, pixels, read.bytes) == 0; });
}

void PixelBuffers::trim() {
  std::vector<Buffer> gone;
  {
    const std::lock_guard lock(mutex_);
    gone.swap(free_);
  }
  for (const Buffer& buffer : gone) gl_.DeleteBuffers(1, &buffer.name);
}

}  // namespace tilepress
