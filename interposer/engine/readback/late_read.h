// Late read: pixels that GL is still writing into a buffer object.
#pragma once

#include <GL/gl.h>

#include <cstddef>
#include <memory>

namespace tilepress {

class PixelBuffers;

/// Made where the read is asked for, ended by PixelBuffers::take or equals, once.
struct LateRead {
  std::shared_ptr<PixelBuffers> buffers;  ///< whose buffer it is
  GLuint buffer = 0;
  void* fence = nullptr;  ///< GLsync: the pixels are there once it is signalled
  size_t bytes = 0;
};

}  // namespace tilepress
