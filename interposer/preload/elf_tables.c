// ELF tables: reads the symbol table and both kinds of hash table (gABI chapter 5; GNU).
#include "elf_tables.h"

#include <elf.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "plain_text.h"

enum { kHiddenVersion = 0x8000 };  // a bit of the version table: not the default version

struct dynamic_tables {
  const ElfW(Sym) * symbols;
  const char* strings;
  const uint32_t* gnu_hash;
  const uint32_t* hash;
  const uint16_t* versions;  // NULL: accept every version
};

// glibc turns these offsets into addresses when it loads an object. musl does not, nor does glibc in the
// vDSO.
static const void* table_address(const struct tp_object* object, ElfW(Addr) value) {
  return (const void*)(value < object->base ? object->base + value : value);
}

static bool read_tables(const struct tp_object* object, struct dynamic_tables* tables) {
  *tables = (struct dynamic_tables){0};
  for (const ElfW(Dyn)* entry = object->dynamic; entry->d_tag != DT_NULL; ++entry) {
    const void* table = table_address(object, entry->d_un.d_ptr);
    if (entry->d_tag == DT_SYMTAB) tables->symbols = table;
    if (entry->d_tag == DT_STRTAB) tables->strings = table;
    if (entry->d_tag == DT_GNU_HASH) tables->gnu_hash = table;
    if (entry->d_tag == DT_HASH) tables->hash = table;
    if (entry->d_tag == DT_VERSYM) tables->versions = table;
  }
  return tables->symbols != NULL && tables->strings != NULL;
}

static bool defines(const struct dynamic_tables* tables, uint32_t index, const char* name) {
  const ElfW(Sym)* symbol = &tables->symbols[index];
  return symbol->st_shndx != SHN_UNDEF && symbol->st_value != 0 && (symbol->st_info & 0xf) == STT_FUNC &&
         (tables->versions == NULL || (tables->versions[index] & kHiddenVersion) == 0) &&
         tp_compare(tables->strings + symbol->st_name, name) == 0;
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

static uint32_t find(const struct dynamic_tables* tables, const char* name) {
  if (tables->gnu_hash != NULL) return find_by_gnu_hash(tables, name);
  return tables->hash != NULL ? find_by_hash(tables, name) : 0;
}

void* tp_function_in(const struct tp_object* object, const char* name) {
  struct dynamic_tables tables;
  if (object->dynamic == NULL || !read_tables(object, &tables)) return NULL;
  uint32_t index = find(&tables, name);
  if (index == 0 && tables.versions != NULL) {
    tables.versions = NULL;
    index = find(&tables, name);
  }
  return index != 0 ? (void*)(object->base + tables.symbols[index].st_value) : NULL;
}

const char* tp_own_name(const struct tp_object* object) {
  struct dynamic_tables tables;
  if (object->dynamic == NULL || !read_tables(object, &tables)) return "";
  for (const ElfW(Dyn)* entry = object->dynamic; entry->d_tag != DT_NULL; ++entry)
    if (entry->d_tag == DT_SONAME) return tables.strings + entry->d_un.d_val;
  return "";
}
