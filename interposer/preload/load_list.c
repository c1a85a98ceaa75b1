// Load list: found through the dynamic linker's symbols for debuggers, else through the program's dynamic
// section.
#include "load_list.h"

#include <elf.h>
#include <stddef.h>
#include <stdint.h>

#include "../system_calls.h"

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

const struct link_map* tp_own_entry(void) {
  const struct link_map* own = NULL;
  if (&glibc_view != NULL) own = own_entry_of(&glibc_view);
  if (own == NULL && &musl_view != NULL) own = own_entry_of(musl_view);
  return own != NULL ? own : own_entry_of(view_of_program());
}
