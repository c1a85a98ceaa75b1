// In-context readback: reads in the program's own context.
#pragma once

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/surface_registry.h"

namespace tilepress {

/// Reads the whole `buffer` (GL_BACK, GL_FRONT) of the default framebuffer into `frame`. Puts back every
/// state it sets, and makes no call that could raise an error flag. Returns false if the context cannot be
/// read like that, because it lacks a query that the format needs.
bool read_in_program_context(const GlFunctions& gl, const SurfaceShape& shape, GLenum buffer,
                             CapturedFrame& frame);

/// Does the same for an attachment of the framebuffer object that is bound for `use`. The framebuffer object
/// must be complete and not multisampled.
bool read_attachment_in_program_context(const GlFunctions& gl, const Attachment& attachment,
                                        FramebufferUse use, const SurfaceShape& shape, CapturedFrame& frame);

}  // namespace tilepress
