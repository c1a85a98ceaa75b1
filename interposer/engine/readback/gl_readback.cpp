// GL readback: reads in the implementation's own format. Any other is converted pixel by pixel on the
// program's thread, and a conversion of 16-bit or 10-bit pixels would lose the surface's own values.
#include "interposer/engine/readback/gl_readback.h"

#include <utility>

#include "interposer/engine/readback/resolve_readback.h"
#include "interposer/engine/readback/transfer.h"
#include "interposer/system_calls.h"

namespace tilepress {

static Transfer transfer_of(PixelFormat format, const GlFunctions& gl) {
  GLint preferred_format = 0, preferred_type = 0;
  gl.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_FORMAT, &preferred_format);
  gl.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_TYPE, &preferred_type);
  gl.clear_errors();  // desktop GL before 4.1 does not have the query
  return tilepress::transfer_of(format, preferred_format, preferred_type);
}

static bool read_bound(const GlFunctions& gl, const SurfaceShape& shape,
                       const std::shared_ptr<PixelBuffers>& buffers, CapturedFrame& frame) {
  frame.buffered_ns = 0;
  const Transfer transfer = transfer_of(*shape.format, gl);
  std::byte* pixels = frame.reserve(shape, transfer.pixel_bytes, transfer.order);
  if (pixels == nullptr) return false;
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  const PixelBuffers::Area area{static_cast<GLsizei>(shape.width), static_cast<GLsizei>(shape.height),
                                transfer.format, transfer.type,
                                size_t{shape.width} * shape.height * transfer.pixel_bytes};
  std::unique_ptr<LateRead> late;
  if (frame.way != ReadWay::kSync && buffers != nullptr && !buffers->refused())
    late = buffers->begin(area, frame.buffered_ns);
  if (late == nullptr && frame.way == ReadWay::kAsync) frame.way = ReadWay::kSync;
  if (frame.way == ReadWay::kAsync) {
    frame.late = std::move(late);
    frame.read_ns = std::exchange(frame.buffered_ns, 0);
    return true;
  }
  const uint64_t begin_ns = now_ns();
  gl.ReadPixels(0, 0, area.width, area.height, area.format, area.type, pixels);
  frame.read_ns = now_ns() - begin_ns;
  bool failed = false;
  while (gl.GetError() != GL_NO_ERROR) failed = true;
  // The pixel buffer must hold the pixels that the call returned, or no pixel buffer is used.
  if (late == nullptr || !buffers->equals(*late, pixels)) frame.buffered_ns = 0;
  return !failed;
}

bool read_back_buffer(const GlFunctions& gl, const SurfaceShape& shape,
                      const std::shared_ptr<PixelBuffers>& buffers, CapturedFrame& frame) {
  return with_back_buffer(gl, shape, [&] { return read_bound(gl, shape, buffers, frame); });
}

}  // namespace tilepress
