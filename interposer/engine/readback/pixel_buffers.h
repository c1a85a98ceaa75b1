// Pixel buffers: the buffer objects of one private context, into which frames are read without waiting for
// them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/readback/late_read.h"

namespace tilepress {

/// A second context that shares the buffers, for the late reader's thread.
struct TwinContext {
  std::function<bool()> enter;  ///< makes it current, without a surface
  std::function<void()> leave;  ///< makes nothing current
  std::function<void()> destroy;
};

/// Of a private context; the buffers die with it and its twin. "In the group" below: with either of the two
/// current.
class PixelBuffers : public std::enable_shared_from_this<PixelBuffers> {
 public:
  /// What a read writes: as glReadPixels has it.
  struct Area {
    GLsizei width, height;
    GLenum format, type;
    size_t bytes;
  };
  PixelBuffers(const GlFunctions& gl, const void* display) : gl_(gl), display_(display) {}
  /// True if the current context has buffers for pixels, and sync objects.
  static bool offered(const GlFunctions& gl);

  /// Starts reading the current read buffer; in the private context. Null if that failed. `took_ns`: the time
  /// of the read alone, the making of a buffer not counted.
  std::unique_ptr<LateRead> begin(const Area& area, uint64_t& took_ns);
  /// Waits for the pixels and copies them to `out`; in the group. False if they are lost.
  bool take(LateRead& read, std::byte* out);
  /// Waits for the pixels and compares them; in the group.
  bool equals(LateRead& read, const std::byte* pixels);
  /// Deletes the buffers that are not in use; in the group.
  void trim();

  const void* display() const { return display_; }
  /// Set on the presenting thread that has the private context, before the first late read.
  void set_twin(TwinContext twin) { twin_ = std::move(twin); }
  const TwinContext* twin() const { return twin_.enter ? &twin_ : nullptr; }
  /// Something failed: no further reads.
  void refuse() { refused_ = true; }
  bool refused() const { return refused_; }

 private:
  struct Buffer {
    GLuint name;
    size_t bytes;
  };
  template <typename Use>
  bool use(LateRead& read, const Use& use);
  bool wait(void* fence) const;
  Buffer acquire(size_t bytes);

  const GlFunctions gl_;
  const void* const display_;
  TwinContext twin_;
  std::atomic<bool> refused_{false};
  std::mutex mutex_;
  std::vector<Buffer> free_;
};

}  // namespace tilepress
