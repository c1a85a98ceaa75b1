// Pixel buffers: the buffer objects of one private context. Reads into them do not wait for the pixels.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "interposer/engine/source/gl_functions.h"

namespace tilepress {

class PixelBuffers;

/// Pixels that GL is still writing into a buffer object. PixelBuffers::begin makes it.
/// PixelBuffers::take or equals ends it, once.
struct LateRead {
  std::shared_ptr<PixelBuffers> buffers;  ///< the group that `buffer` belongs to
  GLuint buffer = 0;
  void* fence = nullptr;  ///< GLsync, signalled when the pixels are there
  size_t bytes = 0;
};

/// A second context that shares the buffers, for the late reader's thread.
struct TwinContext {
  std::function<bool()> enter;  ///< makes it current, without a surface
  std::function<void()> leave;  ///< makes nothing current
  std::function<void()> destroy;
};

/// Belongs to a private context, and the buffers die with that context and its twin. Members that say "in the
/// group" need one of the two to be current.
class PixelBuffers : public std::enable_shared_from_this<PixelBuffers> {
 public:
  /// Arguments of glReadPixels.
  struct Area {
    GLsizei width, height;
    GLenum format, type;
    size_t bytes;
  };
  PixelBuffers(const GlFunctions& gl, const void* display) : gl_(gl), display_(display) {}
  /// Returns true if the current context has pixel buffers and sync objects.
  static bool offered(const GlFunctions& gl);

  /// Starts reading the current read buffer, in the private context. Returns null on failure. `took_ns` is
  /// the time of the read, without that of making a buffer.
  std::unique_ptr<LateRead> begin(const Area& area, uint64_t& took_ns);
  /// Waits for the pixels and copies them to `out`, in the group. Returns false if they are lost.
  bool take(LateRead& read, std::byte* out);
  /// Waits for the pixels and compares them, in the group.
  bool equals(LateRead& read, const std::byte* pixels);
  /// Deletes the buffers that are not in use, in the group.
  void trim();

  const void* display() const { return display_; }
  /// Call it on the presenting thread that has the private context, before the first late read.
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
