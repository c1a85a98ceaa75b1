// Target watch: knows which images a thread has drawn to, and when the thread turns away from them.
#pragma once

#include <cstdint>
#include <vector>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine_contract.h"

namespace tilepress {

/// TilepressEngine.drawn_mark: where the calling thread's draw calls leave their mark.
uint8_t* drawn_mark();

/// Returns true if `call` can mean that the thread turns away from an image it has drawn to. Sets the mark if
/// `call` draws. Calls no GL.
bool concerns_targets(const TilepressGlCall& call);

/// Returns the images that the thread turns away from with `call`: it has drawn to them, and after the call
/// they are no longer draw buffers of the bound framebuffer. Leaves out images that the program invalidates,
/// because they never reach memory. `context` is the context that is current.
std::vector<Attachment> targets_left_by(const GlFunctions& gl, const TilepressGlCall& call,
                                        const void* context);

/// Returns all images that the thread has drawn to, for a present.
std::vector<Attachment> targets_left(const GlFunctions& gl);

}  // namespace tilepress
