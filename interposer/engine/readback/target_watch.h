// Target watch: which of its own images a thread has drawn to, and when it turns away from them.
#pragma once

#include <cstdint>
#include <vector>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine_contract.h"

namespace tilepress {

/// As TilepressEngine.drawn_mark: where the calling thread's draw calls leave their mark.
uint8_t* drawn_mark();

/// True if `call` can mean that the thread turns away from something it has drawn. Marks what draws. Calls no
/// GL.
bool concerns_targets(const TilepressGlCall& call);

/// The images that the thread turns away from with `call`, in the context that is current: drawn to, and
/// about to be no longer the bound framebuffer's draw buffers. Images that the program invalidates were never
/// written to memory and are none of them. `context`: the one that is current.
std::vector<Attachment> targets_left_by(const GlFunctions& gl, const TilepressGlCall& call,
                                        const void* context);

/// The same where the program presents: all that is drawn.
std::vector<Attachment> targets_left(const GlFunctions& gl);

}  // namespace tilepress
