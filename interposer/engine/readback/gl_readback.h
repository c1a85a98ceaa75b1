// GL readback: reads the back buffer of the current surface as the implementation keeps it.
#pragma once

#include <memory>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/surface_registry.h"

namespace tilepress {

/// Reads the whole back buffer into `frame`, or starts to, in the way of `frame.way`, and sets the frame's
/// view. Changes the way to kSync if pixel buffers fail or `buffers` is null. The current context must be a
/// private one: its state and its error flags change. Returns false if nothing was read.
bool read_back_buffer(const GlFunctions& gl, const SurfaceShape& shape,
                      const std::shared_ptr<PixelBuffers>& buffers, CapturedFrame& frame);

}  // namespace tilepress
