// Current drawables: a row per thread that has a drawable. If a thread ends with a context current, its row
// stays. So does the driver's context.
#include "current_drawables.h"

enum { ROWS = 128 };

static struct {
  int taken;
  uintptr_t draw, read, context;
  int context_destroyed;
} rows[ROWS];
static int rows_missing;  // 1 once a thread found no row: the rows are incomplete from then on
static __thread int own_row __attribute__((tls_model("initial-exec")));  // number of the row + 1; 0 = none

void tp_made_current(uintptr_t draw, uintptr_t read, uintptr_t context) {
  for (int row = 0; draw != 0 && own_row == 0 && row < ROWS; ++row) {
    int free_row = 0;
    if (__atomic_compare_exchange_n(&rows[row].taken, &free_row, 1, false, __ATOMIC_ACQ_REL,
                                    __ATOMIC_RELAXED))
      own_row = row + 1;
  }
  if (own_row == 0) {
    if (draw != 0) __atomic_store_n(&rows_missing, 1, __ATOMIC_RELEASE);
    return;
  }
  __atomic_store_n(&rows[own_row - 1].draw, draw, __ATOMIC_RELEASE);
  __atomic_store_n(&rows[own_row - 1].read, read, __ATOMIC_RELEASE);
  __atomic_store_n(&rows[own_row - 1].context_destroyed, 0, __ATOMIC_RELAXED);
  __atomic_store_n(&rows[own_row - 1].context, context, __ATOMIC_RELEASE);
  if (draw != 0) return;
  __atomic_store_n(&rows[own_row - 1].taken, 0, __ATOMIC_RELEASE);
  own_row = 0;
}

void tp_context_destroyed(uintptr_t context) {
  for (int row = 0; context != 0 && row < ROWS; ++row)
    if (__atomic_load_n(&rows[row].taken, __ATOMIC_ACQUIRE) != 0 &&
        __atomic_load_n(&rows[row].context, __ATOMIC_ACQUIRE) == context)
      __atomic_store_n(&rows[row].context_destroyed, 1, __ATOMIC_RELEASE);
}

bool tp_current_context_is_destroyed(void) {
  return own_row != 0 && __atomic_load_n(&rows[own_row - 1].context_destroyed, __ATOMIC_ACQUIRE) != 0;
}

bool tp_is_current_elsewhere(uintptr_t drawable) {
  if (own_row != 0 && rows[own_row - 1].draw == drawable) return false;
  if (__atomic_load_n(&rows_missing, __ATOMIC_ACQUIRE) != 0) return true;
  for (int row = 0; row < ROWS; ++row) {
    if (row == own_row - 1 || __atomic_load_n(&rows[row].taken, __ATOMIC_ACQUIRE) == 0) continue;
    if (__atomic_load_n(&rows[row].draw, __ATOMIC_ACQUIRE) == drawable ||
        __atomic_load_n(&rows[row].read, __ATOMIC_ACQUIRE) == drawable)
      return true;
  }
  return false;
}
