// GL readback: reads the back buffer of the current surface as the implementation keeps it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine/surface_registry.h"

namespace tilepress {

/// Bits of each colour channel of a config or visual.
struct ChannelBits {
  int red = 0, green = 0, blue = 0, alpha = 0;
  bool floating = false;
  bool integer = false;  ///< not normalized, or signed
};

/// The pixel format whose memory layout holds exactly these channels; empty if there is none.
std::optional<PixelFormat> format_of(const ChannelBits& bits);

/// Reads the whole back buffer into `frame`, or starts to, in the way that `frame.way` asks for, and sets its
/// view. Where pixel buffers fail, or `buffers` is null, the way is kSync. The current context is private to
/// the shim: its state and its error flags are ours. False, with the GL error or 0 in `error`, if nothing was
/// read.
bool read_back_buffer(const GlFunctions& gl, const SurfaceShape& shape,
                      const std::shared_ptr<PixelBuffers>& buffers, CapturedFrame& frame, GLenum& error);

}  // namespace tilepress
