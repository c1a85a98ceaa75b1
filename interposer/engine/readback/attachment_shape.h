// Attachment shape: the size and format of an image of a framebuffer object.
#pragma once

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "tilepress/result.h"

namespace tilepress {

struct ImageShape {
  SurfaceShape shape;
  GLint samples = 0;  ///< 0: not multisampled
};

/// In the program's context. OpenGL 4.5 has a query for the size of an image by its name. Older contexts have
/// no query that is free of errors, and the function fails.
Result<ImageShape> shape_in_program_context(const GlFunctions& gl, const Attachment& attachment);

/// In a private context that shares the program's objects. Finds a texture's target by binding the texture to
/// one target after the other: GL has no query for the target, and a wrong one raises an error. Makes no
/// object, because the program's context would see the name of a new one.
Result<ImageShape> shape_in_sharing_context(const GlFunctions& gl, const Attachment& attachment);

}  // namespace tilepress
