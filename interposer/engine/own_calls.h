// Own calls: marks a thread on which what comes along the hooks is the shim's own.
#pragma once

namespace tilepress {

/// True on a thread that is between begin and end, or in another call of the engine. Where both roads are
/// open, a call that one has seen comes along the other once more; and our own calls come along it too.
inline thread_local bool inside_engine = false;

}  // namespace tilepress
