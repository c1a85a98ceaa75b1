// GL trigger: the GL calls that end a frame without presenting it.
#pragma once

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine_contract.h"

namespace tilepress {

/// `kind`: enum TilepressGlKind.
bool is_trigger(uint32_t kind);

/// The name of a trigger in presents.csv: "finish", "flush" or "readpixels".
const char* cause_of(uint32_t kind);

/// The framebuffer whose frame the call ends: glReadPixels ends the one it reads, the others the one drawn
/// to.
FramebufferUse use_of(uint32_t kind);

/// Where both roads are open, a trigger comes along the preload road first and then along libglvnd's. Returns
/// true for the second time. Keeps its state per thread.
bool comes_again(const TilepressGlCall& call);

/// By default both glFlush and glFinish end a frame of an OSMesa program. Returns true if `frame` ends with
/// the second of the two and the same pixels, so nothing was drawn in between. Keeps its state per thread.
bool is_second_of_pair(uint32_t kind, const CapturedFrame& frame);

}  // namespace tilepress
