// Resolve readback: reads multisampled images and surfaces as their samples resolve.
#pragma once

#include <functional>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/surface_registry.h"
#include "tilepress/result.h"

namespace tilepress {

/// In a private context that shares the program's objects. Resolves the image into a single-sampled one of
/// the same format and reads that into `frame`. Leaves no object behind.
Result<void> read_resolved(const GlFunctions& gl, const Attachment& attachment, const SurfaceShape& shape,
                           CapturedFrame& frame);

/// In a private context. Returns what `read` returns, whose reads take the back buffer of the surface that is
/// current. A multisampled surface is resolved first: Mesa's glReadPixels returns one sample of each pixel,
/// while the window shows their mean. Returns false without reading if the resolve fails.
bool with_back_buffer(const GlFunctions& gl, const SurfaceShape& shape, const std::function<bool()>& read);

}  // namespace tilepress
