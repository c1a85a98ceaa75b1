// Late read: pixels that GL is still writing into a buffer object.
#pragma once

#include <GL/gl.h>

#include <cstddef>
#include <memory>

namespace tilepress {

class PixelBuffers;

/// PixelBuffers::begin makes it. PixelBuffers::take or equals ends it, once.
struct LateRead {
  std::shared_ptr<PixelBuffers> buffers;  ///< the group that `buffer` belongs to
  GLuint buffer = 0;
  void* fence = nullptr;  ///< GLsync, signalled when the pixels are there
  size_t bytes = 0;
};

}  // namespace tilepress
