// ELF symbols: walks over the loaded objects. The dynamic linker keeps its list unchanged meanwhile.
#define _GNU_SOURCE
#include "elf_symbols.h"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <stddef.h>
#include <stdint.h>

#include "c_library.h"
#include "elf_tables.h"
#include "plain_text.h"

struct search {
  const char* name;    // symbol to find
  const void* inside;  // an address in the object to search; NULL = any object
  const void* except;  // an address in an object to skip
  bool skip_ours;
  int position;
  void* found;
  struct tp_text* path;  // receives the path of the object
};

static bool holds(const struct dl_phdr_info* object, const void* address) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)* segment = &object->dlpi_phdr[i];
    const uintptr_t start = object->dlpi_addr + segment->p_vaddr;
    if (segment->p_type == PT_LOAD && (uintptr_t)address - start < segment->p_memsz) return true;
  }
  return false;
}

static void* find_in(const struct dl_phdr_info* info, const char* name) {
  struct tp_object object = {info->dlpi_addr, NULL};
  for (int i = 0; i < info->dlpi_phnum; ++i)
    if (info->dlpi_phdr[i].p_type == PT_DYNAMIC)
      object.dynamic = (const void*)(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr);
  return tp_function_in(&object, name);
}

static int visit(struct dl_phdr_info* object, size_t size, void* argument) {
  (void)size;
  struct search* search = argument;
  const int position = search->position++;
  if (search->inside != NULL && !holds(object, search->inside)) return 0;
  if (search->except != NULL && holds(object, search->except)) return 0;
  if (search->skip_ours && holds(object, (const void*)&visit)) return 0;
  if (search->path != NULL && object->dlpi_name != NULL) tp_append(search->path, object->dlpi_name);
  if (search->name == NULL) {
    search->position = position;
    return 1;
  }
  search->found = find_in(object, search->name);
  return search->found != NULL || search->inside != NULL;
}

static bool walk(struct search* search) {
  const struct tp_c_library* library = tp_c_library();
  return library != NULL && library->dl_iterate_phdr(visit, search) != 0;
}

void* tp_symbol_in_object_of(const void* address, const char* name) {
  struct search search = {.name = name, .inside = address};
  walk(&search);
  return search.found;
}

void* tp_symbol_anywhere(const char* name, const void* except) {
  struct search search = {.name = name, .except = except, .skip_ours = true};
  walk(&search);
  return search.found;
}

int tp_load_position(const void* address) {
  struct search search = {.inside = address};
  return walk(&search) ? search.position : -1;
}

bool tp_is_ours(const void* address) {
  return tp_same_object(address, (const void*)&visit);
}

bool tp_same_object(const void* a, const void* b) {
  const int position = tp_load_position(a);
  return position >= 0 && position == tp_load_position(b);
}

bool tp_path_of_object(const void* address, char* path, size_t size) {
  struct tp_text text = {path, size, 0, false};
  path[0] = 0;
  struct search search = {.inside = address, .path = &text};
  return walk(&search) && text.length > 0 && !text.cut;
}

void* tp_handle_of_object(const void* address) {
  const struct tp_c_library* library = tp_c_library();
  Dl_info where;
  void* object = NULL;
  if (library == NULL || library->dladdr1 == NULL ||
      library->dladdr1(address, &where, &object, RTLD_DL_LINKMAP) == 0)
    return NULL;
  return object;
}
