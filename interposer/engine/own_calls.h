// Own calls: marks a thread whose calls through the hooks are the shim's own.
#pragma once

namespace tilepress {

/// True on a thread that is between begin and end, or in another call of the engine. If both roads are open,
/// a call comes along each of them, and our own calls come along the second one too.
inline thread_local bool inside_engine = false;

}  // namespace tilepress
