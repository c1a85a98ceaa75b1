// C library: glibc before 2.34 has dlsym in libdl, later in libc. musl names its library after the machine.
#include "c_library.h"

#include <elf.h>
#include <link.h>
#include <stddef.h>
#include <stdint.h>

#include "../system_calls.h"
#include "elf_tables.h"
#include "plain_text.h"

// The load list: the objects of the process in load order, as the dynamic linker shows them to debuggers.
// Reading it calls no function of another library, takes no lock, and works before this library is relocated.

// glibc's struct r_debug_extended, which older headers lack. musl has the members before `next`.
struct debugger_view {
  int version;
  struct link_map* first;
  ElfW(Addr) breakpoint;
  int state;
  ElfW(Addr) linker_base;
  struct debugger_view* next;  // another namespace; exists from version 2 on
};

// Weak: a C library has one of the two.
extern struct debugger_view glibc_view __asm__("_r_debug") __attribute__((weak));
extern struct debugger_view* musl_view __asm__("_dl_debug_addr") __attribute__((weak));

extern __attribute__((visibility("hidden"))) ElfW(Dyn) _DYNAMIC[];

static const struct link_map* own_entry_of(const struct debugger_view* view) {
  for (; view != NULL; view = view->version >= 2 ? view->next : NULL)
    for (const struct link_map* entry = view->first; entry != NULL; entry = entry->l_next)
      if (entry->l_ld == _DYNAMIC) return entry;
  return NULL;
}

static uintptr_t view_in(const ElfW(Phdr) * header, size_t count) {
  uintptr_t base = 0;
  for (size_t i = 0; i < count; ++i)
    if (header[i].p_type == PT_PHDR) base = (uintptr_t)header - header[i].p_vaddr;
  for (size_t i = 0; i < count; ++i) {
    if (header[i].p_type != PT_DYNAMIC) continue;
    for (const ElfW(Dyn)* entry = (const void*)(base + header[i].p_vaddr); entry->d_tag != DT_NULL; ++entry)
      if (entry->d_tag == DT_DEBUG) return entry->d_un.d_ptr;
  }
  return 0;
}

// The dynamic linker writes the address of its list into the program's dynamic section.
static const struct debugger_view* view_of_program(void) {
  ElfW(auxv_t) vector[64];
  const int file = tp_open("/proc/self/auxv", O_RDONLY, 0);
  if (file < 0) return NULL;
  const long bytes = tp_read(file, vector, sizeof vector);
  tp_close(file);
  const ElfW(Phdr)* header = NULL;
  size_t count = 0;
  for (size_t i = 0; bytes > 0 && i < (size_t)bytes / sizeof *vector; ++i) {
    if (vector[i].a_type == AT_PHDR) header = (const void*)vector[i].a_un.a_val;
    if (vector[i].a_type == AT_PHNUM) count = vector[i].a_un.a_val;
  }
  return header != NULL ? (const struct debugger_view*)view_in(header, count) : NULL;
}

// Returns this library's own entry, or NULL if no list holds it. Read only the entries of objects that the
// program started with: others can disappear at any time.
static const struct link_map* own_entry(void) {
  const struct link_map* own = NULL;
  if (&glibc_view != NULL) own = own_entry_of(&glibc_view);
  if (own == NULL && &musl_view != NULL) own = own_entry_of(musl_view);
  return own != NULL ? own : own_entry_of(view_of_program());
}

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
  const struct link_map* own = own_entry();
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
  const struct link_map* own = own_entry();
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
