// Engine loader: the engine lies beside this library, or in the folder tilepress/ beside it.
#define _GNU_SOURCE
#include "engine_loader.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "real_dlsym.h"
#include "session_file.h"

static const struct TilepressEngine* loaded;

static void* open_beside(const char* own_path, const char* name) {
  char path[4096];
  const char* slash = strrchr(own_path, '/');
  const int folder_length = slash != NULL ? (int)(slash - own_path) + 1 : 0;
  const int length = snprintf(path, sizeof path, "%.*s%s", folder_length, own_path, name);
  return length < (int)sizeof path ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
}

static void report(const char* reason) {
  const char* path = getenv("TILEPRESS_LOG_FILE");
  FILE* file = path != NULL && path[0] != 0 ? fopen(path, "ae") : NULL;
  if (file == NULL) return;
  fprintf(file, "tilepress: engine: %s\n", reason != NULL ? reason : "not loaded");
  fclose(file);
}

static void load(void) {
  const char* output = getenv("TILEPRESS_OUT");
  Dl_info own;
  if (output == NULL || output[0] == 0 || dladdr((void*)&load, &own) == 0) return;
  void* library = open_beside(own.dli_fname, "libtilepress-engine.so");
  if (library == NULL) library = open_beside(own.dli_fname, "tilepress/libtilepress-engine.so");
  if (library == NULL) {
    report(dlerror());
    return;
  }
  TilepressEngineEntry entry = (TilepressEngineEntry)tp_real_dlsym()(library, "tilepress_engine");
  static struct TilepressHost host = {TILEPRESS_ENGINE_VERSION, NULL};
  host.dlsym = tp_real_dlsym();
  const struct TilepressEngine* engine = entry != NULL ? entry(&host) : NULL;
  if (engine == NULL) report("of another version");
  __atomic_store_n(&loaded, engine, __ATOMIC_RELEASE);
}

const struct TilepressEngine* tp_engine(void) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  pthread_once(&once, load);
  return __atomic_load_n(&loaded, __ATOMIC_ACQUIRE);
}

const struct TilepressEngine* tp_loaded_engine(void) {
  return __atomic_load_n(&loaded, __ATOMIC_ACQUIRE);
}
