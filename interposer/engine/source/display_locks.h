// Display locks: whether several threads may use an X connection.
#pragma once

#include <X11/Xlib.h>

namespace tilepress {

/// Returns true if `display` was opened after XInitThreads, which libX11 calls by itself from 1.8 on.
bool has_locks(Display* display);

}  // namespace tilepress
