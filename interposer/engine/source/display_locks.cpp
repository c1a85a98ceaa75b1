// Display locks: Xlibint.h, whose macros should meet no other header, shows what extension libraries lock
// with.
#include "interposer/engine/source/display_locks.h"

#include <X11/Xlibint.h>

namespace tilepress {

bool has_locks(Display* display) {
  return display->lock_fns != nullptr;
}

}  // namespace tilepress
