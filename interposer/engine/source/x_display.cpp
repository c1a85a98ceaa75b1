// X display: Xlibint.h has the locks of a display. Its macros must not meet another header.
#include "interposer/engine/source/x_display.h"

#include <X11/Xlibint.h>

namespace tilepress {

bool has_locks(Display* display) {
  return display->lock_fns != nullptr;
}

}  // namespace tilepress
