// Plain text: string functions. The C library's may be replaced by the program's, or by those of a sanitizer
// that is not ready yet.
#pragma once

#include <stdbool.h>
#include <stddef.h>

static inline size_t tp_length(const char* text) {
  size_t length = 0;
  while (text[length] != 0) ++length;
  return length;
}

// Returns what strcmp returns.
static inline int tp_compare(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return (int)(unsigned char)*a - (int)(unsigned char)*b;
}

static inline bool tp_starts_with(const char* text, const char* start) {
  while (*start != 0 && *text == *start) ++text, ++start;
  return *start == 0;
}

static inline bool tp_contains(const char* text, const char* part) {
  for (;; ++text) {
    if (tp_starts_with(text, part)) return true;
    if (*text == 0) return false;
  }
}

// Returns the part of a path behind its last slash.
static inline const char* tp_base_name(const char* path) {
  const char* base = path;
  for (; *path != 0; ++path)
    if (*path == '/') base = path + 1;
  return base;
}

// A text in the caller's buffer, always with a zero behind it. `cut`: an appended part did not fit.
struct tp_text {
  char* bytes;
  size_t size, length;
  bool cut;
};

static inline void tp_append_part(struct tp_text* text, const char* part, size_t part_length) {
  for (size_t i = 0; i < part_length; ++i) {
    if (text->length + 1 >= text->size) {
      text->cut = true;
      break;
    }
    text->bytes[text->length++] = part[i];
  }
  text->bytes[text->length] = 0;
}

static inline void tp_append(struct tp_text* text, const char* part) {
  tp_append_part(text, part, tp_length(part));
}

static inline void tp_append_number(struct tp_text* text, unsigned long number) {
  char digits[24];
  size_t first = sizeof digits;
  do digits[--first] = (char)('0' + number % 10);
  while ((number /= 10) != 0);
  tp_append_part(text, digits + first, sizeof digits - first);
}
