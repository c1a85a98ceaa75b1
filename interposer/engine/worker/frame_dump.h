// Frame dump: writes captured frames as raw pixels, for tests and for people who want to see what was
// compressed.
#pragma once

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/shim_log.h"

namespace tilepress {

/// Writes `frame` to $TILEPRESS_DUMP/<surface>-<frame>.rgba, top row first, rows tight, pixels as their
/// canonical bytes (R,G,B,A for 8-bit channels; the native 2 or 4 bytes, little-endian, otherwise). Nothing
/// without the variable.
void dump_frame(const CapturedFrame& frame, const ShimLog& log);

}  // namespace tilepress
