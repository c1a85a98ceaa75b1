// Engine loader: the engine lies beside this library, or in the folder tilepress/ beside it.
#define _GNU_SOURCE
#include "engine_loader.h"

#include <dlfcn.h>
#include <stddef.h>

#include "../system_calls.h"
#include "c_library.h"
#include "elf_symbols.h"
#include "environment.h"
#include "plain_text.h"
#include "session_file.h"

static const struct TilepressEngine* loaded;

static void* open_beside(const char* own_path, const char* name) {
  char bytes[4096];
  struct tp_text path = {bytes, sizeof bytes, 0, false};
  tp_append_part(&path, own_path, (size_t)(tp_base_name(own_path) - own_path));
  tp_append(&path, name);
  return path.cut ? NULL : tp_c_library()->dlopen(bytes, RTLD_NOW | RTLD_LOCAL);
}

static void report(const char* reason) {
  char bytes[2048];
  struct tp_text line = {bytes, sizeof bytes, 0, false};
  tp_append(&line, "tilepress: engine: ");
  tp_append(&line, reason != NULL ? reason : "not loaded");
  tp_session_log(bytes);
}

static void load(void) {
  const struct tp_c_library* library = tp_c_library();
  char own_path[4096];
  if (library == NULL || !library->is_glibc || tp_environment("TILEPRESS_OUT") == NULL ||
      !tp_path_of_object((void*)&load, own_path, sizeof own_path))
    return;
  void* opened = open_beside(own_path, "libtilepress-engine.so");
  if (opened == NULL) opened = open_beside(own_path, "tilepress/libtilepress-engine.so");
  if (opened == NULL) {
    report(library->dlerror());
    return;
  }
  TilepressEngineEntry entry = (TilepressEngineEntry)library->dlsym(opened, "tilepress_engine");
  static struct TilepressHost host = {TILEPRESS_ENGINE_VERSION, NULL, tp_path_of_object};
  host.dlsym = library->dlsym;
  const struct TilepressEngine* engine = entry != NULL ? entry(&host) : NULL;
  if (engine == NULL) report("its version does not match the preloaded library");
  __atomic_store_n(&loaded, engine, __ATOMIC_RELEASE);
}

const struct TilepressEngine* tp_engine(void) {
  enum { kTried = -1 };
  // 0, kTried, or the id of the process that loads the engine now. A forked child does not wait for its
  // parent.
  static int state;
  int seen = __atomic_load_n(&state, __ATOMIC_ACQUIRE);
  while (seen != kTried) {
    const int process = tp_process_id();
    if (seen == process) {
      tp_wait_while(&state, process);
      seen = __atomic_load_n(&state, __ATOMIC_ACQUIRE);
    } else if (__atomic_compare_exchange_n(&state, &seen, process, false, __ATOMIC_ACQ_REL,
                                           __ATOMIC_ACQUIRE)) {
      load();
      __atomic_store_n(&state, kTried, __ATOMIC_RELEASE);
      tp_wake(&state);
      break;
    }
  }
  return __atomic_load_n(&loaded, __ATOMIC_ACQUIRE);
}

const struct TilepressEngine* tp_loaded_engine(void) {
  return __atomic_load_n(&loaded, __ATOMIC_ACQUIRE);
}
