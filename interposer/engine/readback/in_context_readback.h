// In-context readback: the way out where no private context can be had: reads in the program's own context.
#pragma once

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/surface_registry.h"

namespace tilepress {

/// Reads the whole of the default framebuffer's `buffer` (GL_BACK, GL_FRONT) in the current, foreign context
/// into `frame`. Every state it sets is put back, and no call is made that could raise an error flag. False
/// if the context cannot be read so (the format needs a question that this context does not know).
bool read_in_program_context(const GlFunctions& gl, const SurfaceShape& shape, GLenum buffer,
                             CapturedFrame& frame);

/// The same for an attachment of the framebuffer object bound for `use`, which is complete and not
/// multisampled.
bool read_attachment_in_program_context(const GlFunctions& gl, const Attachment& attachment,
                                        FramebufferUse use, const SurfaceShape& shape, CapturedFrame& frame);

}  // namespace tilepress
