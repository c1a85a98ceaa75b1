// Plain memory: the functions that the compiler itself calls to copy and clear. They are hidden, so that no
// call reaches the program's own definitions.
#include <stddef.h>
#include <stdint.h>

#define HIDDEN __attribute__((visibility("hidden")))

HIDDEN void* memcpy(void* restrict to, const void* restrict from, size_t count) {
  for (size_t i = 0; i < count; ++i) ((uint8_t*)to)[i] = ((const uint8_t*)from)[i];
  return to;
}

HIDDEN void* memmove(void* to, const void* from, size_t count) {
  if ((uintptr_t)to - (uintptr_t)from >= count) return memcpy(to, from, count);
  while (count-- > 0) ((uint8_t*)to)[count] = ((const uint8_t*)from)[count];
  return to;
}

HIDDEN void* memset(void* to, int value, size_t count) {
  for (size_t i = 0; i < count; ++i) ((uint8_t*)to)[i] = (uint8_t)value;
  return to;
}

HIDDEN int memcmp(const void* a, const void* b, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const int difference = ((const uint8_t*)a)[i] - ((const uint8_t*)b)[i];
    if (difference != 0) return difference;
  }
  return 0;
}
