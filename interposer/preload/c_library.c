// C library: glibc before 2.34 has dlsym in libdl, later in libc. musl names its library after the machine.
#include "c_library.h"

#include <stddef.h>

#include "elf_tables.h"
#include "load_list.h"
#include "plain_text.h"

static struct tp_object object_of(const struct link_map* entry) {
  return (struct tp_object){entry->l_addr, entry->l_ld};
}

static bool is_of_c_library(const struct link_map* entry) {
  const struct tp_object object = object_of(entry);
  const char* own_name = tp_own_name(&object);
  const char* file = entry->l_name != NULL ? tp_base_name(entry->l_name) : "";
  return tp_starts_with(own_name, "libc.so") || tp_starts_with(own_name, "libdl.so") ||
         tp_starts_with(own_name, "libpthread.so") || tp_starts_with(own_name, "libc.musl") ||
         tp_starts_with(file, "ld-musl");
}

// Searches in load order from `entry` on.
static void* find_from(const struct link_map* entry, const char* name, bool any_library) {
  for (; entry != NULL; entry = entry->l_next) {
    const struct tp_object object = object_of(entry);
    void* found = any_library || is_of_c_library(entry) ? tp_function_in(&object, name) : NULL;
    if (found != NULL) return found;
  }
  return NULL;
}

static const struct link_map* first_entry(const struct link_map* entry) {
  while (entry != NULL && entry->l_prev != NULL) entry = entry->l_prev;
  return entry;
}

void* tp_function_behind_ours(const char* name) {
  const struct link_map* own = tp_own_entry();
  return own != NULL ? find_from(own->l_next, name, true) : NULL;
}

static void find_functions(const struct link_map* first, struct tp_c_library* library) {
  library->is_glibc = find_from(first, "gnu_get_libc_version", false) != NULL;
  *(void**)&library->dlsym = find_from(first, "dlsym", false);
  if (library->is_glibc) {
    *(void**)&library->dlvsym = find_from(first, "dlvsym", false);
    *(void**)&library->dladdr1 = find_from(first, "dladdr1", false);
  }
  *(void**)&library->dlopen = find_from(first, "dlopen", false);
  *(void**)&library->dlerror = find_from(first, "dlerror", false);
  *(void**)&library->dl_iterate_phdr = find_from(first, "dl_iterate_phdr", false);
  *(void**)&library->pthread_setcancelstate = find_from(first, "pthread_setcancelstate", false);
  *(void**)&library->errno_location = find_from(first, "__errno_location", false);
}

const struct tp_c_library* tp_c_library(void) {
  static struct tp_c_library known;
  static bool found;
  if (__atomic_load_n(&found, __ATOMIC_ACQUIRE)) return &known;
  const struct link_map* own = tp_own_entry();
  struct tp_c_library library = {0};
  find_functions(first_entry(own), &library);
  if (library.dlsym == NULL || library.dlopen == NULL || library.dlerror == NULL ||
      library.dl_iterate_phdr == NULL || library.pthread_setcancelstate == NULL ||
      library.errno_location == NULL)
    return NULL;
  *(void**)&library.next_dlsym = find_from(own->l_next, "dlsym", true);
  if (library.dlvsym != NULL) *(void**)&library.next_dlvsym = find_from(own->l_next, "dlvsym", true);
  // If the program opened this library with dlopen, it stands behind the C library.
  if (library.next_dlsym == NULL) library.next_dlsym = library.dlsym;
  if (library.next_dlvsym == NULL) library.next_dlvsym = library.dlvsym;
  known = library;  // two threads write the same bytes
  __atomic_store_n(&found, true, __ATOMIC_RELEASE);
  return &known;
}
