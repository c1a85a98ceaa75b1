// ELF symbols: reads the dynamic section of loaded objects (gABI chapter 5, and the GNU hash table).
#define _GNU_SOURCE
#include "elf_symbols.h"

#include <elf.h>
#include <link.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

struct dynamic_tables {
  const ElfW(Sym) * symbols;
  const char* strings;
  const uint32_t* gnu_hash;
  const uint32_t* hash;
};

static bool holds(const struct dl_phdr_info* object, const void* address) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)* segment = &object->dlpi_phdr[i];
    const uintptr_t start = object->dlpi_addr + segment->p_vaddr;
    if (segment->p_type == PT_LOAD && (uintptr_t)address - start < segment->p_memsz) return true;
  }
  return false;
}

// glibc rewrites these addresses when it loads an object, musl does not.
static const void* table_address(const struct dl_phdr_info* object, ElfW(Addr) value) {
  const void* address = (const void*)value;
  return holds(object, address) ? address : (const void*)(object->dlpi_addr + value);
}

static bool read_tables(const struct dl_phdr_info* object, struct dynamic_tables* tables) {
  memset(tables, 0, sizeof *tables);
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    if (object->dlpi_phdr[i].p_type != PT_DYNAMIC) continue;
    const ElfW(Dyn)* entry = (const void*)(object->dlpi_addr + object->dlpi_phdr[i].p_vaddr);
    for (; entry->d_tag != DT_NULL; ++entry) {
      if (entry->d_tag == DT_SYMTAB) tables->symbols = table_address(object, entry->d_un.d_ptr);
      if (entry->d_tag == DT_STRTAB) tables->strings = table_address(object, entry->d_un.d_ptr);
      if (entry->d_tag == DT_GNU_HASH) tables->gnu_hash = table_address(object, entry->d_un.d_ptr);
      if (entry->d_tag == DT_HASH) tables->hash = table_address(object, entry->d_un.d_ptr);
    }
  }
  return tables->symbols != NULL && tables->strings != NULL;
}

static bool defines(const struct dynamic_tables* tables, uint32_t index, const char* name) {
  const ElfW(Sym)* symbol = &tables->symbols[index];
  return symbol->st_shndx != SHN_UNDEF && symbol->st_value != 0 && (symbol->st_info & 0xf) == STT_FUNC &&
         strcmp(tables->strings + symbol->st_name, name) == 0;
}

static uint32_t find_by_gnu_hash(const struct dynamic_tables* tables, const char* name) {
  const uint32_t bucket_count = tables->gnu_hash[0], first = tables->gnu_hash[1],
                 bloom_words = tables->gnu_hash[2];
  if (bucket_count == 0) return 0;
  const uint32_t* buckets = (const uint32_t*)((const ElfW(Addr)*)(tables->gnu_hash + 4) + bloom_words);
  const uint32_t* chain = buckets + bucket_count;
  uint32_t hash = 5381;
  for (const char* c = name; *c != 0; ++c) hash = hash * 33 + (unsigned char)*c;
  uint32_t index = buckets[hash % bucket_count];
  if (index < first) return 0;
  for (;; ++index) {
    const uint32_t entry = chain[index - first];
    if ((entry | 1) == (hash | 1) && defines(tables, index, name)) return index;
    if ((entry & 1) != 0) return 0;
  }
}

static uint32_t find_by_hash(const struct dynamic_tables* tables, const char* name) {
  const uint32_t symbol_count = tables->hash[1];
  for (uint32_t index = 1; index < symbol_count; ++index)
    if (defines(tables, index, name)) return index;
  return 0;
}

static void* find_in_object(const struct dl_phdr_info* object, const char* name) {
  struct dynamic_tables tables;
  if (!read_tables(object, &tables)) return NULL;
  uint32_t index = 0;
  if (tables.gnu_hash != NULL)
    index = find_by_gnu_hash(&tables, name);
  else if (tables.hash != NULL)
    index = find_by_hash(&tables, name);
  return index != 0 ? (void*)(object->dlpi_addr + tables.symbols[index].st_value) : NULL;
}

struct search {
  const char* name;             // symbol wanted
  const char* const* prefixes;  // of the file's name; NULL = any object
  const void* inside;           // an address in the object wanted; NULL = any object
  const void* except;           // an address in an object to leave out
  bool skip_ours;
  int position;
  void* found;
};

static bool name_matches(const char* path, const char* const* prefixes) {
  const char* slash = strrchr(path, '/');
  const char* base = slash != NULL ? slash + 1 : path;
  for (; *prefixes != NULL; ++prefixes)
    if (strncmp(base, *prefixes, strlen(*prefixes)) == 0) return true;
  return false;
}

static int visit(struct dl_phdr_info* object, size_t size, void* argument) {
  (void)size;
  struct search* search = argument;
  const int position = search->position++;
  if (search->prefixes != NULL && !name_matches(object->dlpi_name, search->prefixes)) return 0;
  if (search->inside != NULL && !holds(object, search->inside)) return 0;
  if (search->except != NULL && holds(object, search->except)) return 0;
  if (search->skip_ours && holds(object, (const void*)&visit)) return 0;
  if (search->name == NULL) {
    search->position = position;
    return 1;
  }
  search->found = find_in_object(object, search->name);
  return search->found != NULL || search->inside != NULL;
}

void* tp_symbol_in_library(const char* const* prefixes, const char* name) {
  struct search search = {.name = name, .prefixes = prefixes};
  dl_iterate_phdr(visit, &search);
  return search.found;
}

void* tp_symbol_in_object_of(const void* address, const char* name) {
  struct search search = {.name = name, .inside = address};
  dl_iterate_phdr(visit, &search);
  return search.found;
}

void* tp_symbol_anywhere(const char* name, const void* except) {
  struct search search = {.name = name, .except = except, .skip_ours = true};
  dl_iterate_phdr(visit, &search);
  return search.found;
}

int tp_load_position(const void* address) {
  struct search search = {.inside = address};
  return dl_iterate_phdr(visit, &search) != 0 ? search.position : -1;
}

bool tp_is_ours(const void* address) {
  return tp_same_object(address, (const void*)&visit);
}

bool tp_same_object(const void* a, const void* b) {
  const int position = tp_load_position(a);
  return position >= 0 && position == tp_load_position(b);
}
