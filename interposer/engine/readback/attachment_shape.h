// Attachment shape: the size of an image of the program, which its own context does not tell without an
// error.
#pragma once

#include <string>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/surface_registry.h"

namespace tilepress {

/// In the program's context, where OpenGL 4.5 tells the size of an image by its name. False where it does
/// not.
bool shape_in_program_context(const GlFunctions& gl, const Attachment& attachment, SurfaceShape& shape,
                              GLint& samples);

/// In a private context that shares the program's objects: of what kind a texture is nobody tells, and to
/// bind it as another kind is an error. Makes no object, for the names of most kinds are shared. False, with
/// the reason, if the size cannot be had.
bool shape_in_sharing_context(const GlFunctions& gl, const Attachment& attachment, SurfaceShape& shape,
                              GLint& samples, std::string& reason);

}  // namespace tilepress
