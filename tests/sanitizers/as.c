// An assembler for g++'s sanitized code: removes what makes programs with both sanitizers start slowly, then runs `as`.
//
// g++ writes a table for each check of the undefined sanitizer. The address sanitizer then guards each of these tables
// as a variable of the program: with a descriptor, a name and a red zone, four times the size of the table itself.
// A program registers a million of them whenever it starts. No code of the program reads them, so this assembler
// drops their descriptors, names and red zones. All other variables stay guarded.
//
// Text of another form than expected goes to `as` unchanged.
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { kWordsOfDescriptor = 8 };

static const char kTableLabel[] = "\n.LASAN0:\n";
static const char kWord[] = "\t.quad\t";
static const char kCheckTable[] = ".Lubsan_";
static const char kCheckName[] = "\t.string\t\"*.Lubsan_";

static int begins(const char* text, const char* start) { return strncmp(text, start, strlen(start)) == 0; }

static const char* line_after(const char* line) {
  const char* end = strchr(line, '\n');
  return end != NULL ? end + 1 : line + strlen(line);
}

struct descriptors {
  const char* begin;
  const char* end;
  unsigned all;
  unsigned kept;
};

// Counts the descriptors of the file. Returns 0 if there are none or a descriptor is incomplete.
static int find_descriptors(const char* text, struct descriptors* found) {
  const char* label = strstr(text, kTableLabel);
  if (label == NULL) {
    return 0;
  }
  *found = (struct descriptors){.begin = label + strlen(kTableLabel)};
  const char* line = found->begin;
  while (begins(line, kWord)) {
    found->all++;
    found->kept += !begins(line + strlen(kWord), kCheckTable);
    for (int word = 0; word < kWordsOfDescriptor; word++, line = line_after(line)) {
      if (!begins(line, kWord)) {
        return 0;
      }
    }
  }
  found->end = line;
  return found->all > 0;
}

// Whether the line sets the number of descriptors for a call of the address sanitizer.
static int sets_count(const char* line, const struct descriptors* found) {
  char expected[64];
  snprintf(expected, sizeof(expected), "\tmovl\t$%u, %%esi\n", found->all);
  if (!begins(line, expected)) {
    return 0;
  }
  for (int i = 0; i < 3; i++) {
    line = line_after(line);
    if (begins(line, "\tcall\t__asan_register_globals") || begins(line, "\tcall\t__asan_unregister_globals")) {
      return 1;
    }
  }
  return 0;
}

// The number of bytes that a line of data fills, or 0 for lines of another kind.
static unsigned long filled_bytes(const char* line) {
  if (begins(line, "\t.quad\t")) {
    return 8;
  }
  if (begins(line, "\t.long\t")) {
    return 4;
  }
  if (begins(line, "\t.value\t")) {
    return 2;
  }
  if (begins(line, "\t.byte\t")) {
    return 1;
  }
  return begins(line, "\t.zero\t") ? strtoul(line + strlen("\t.zero\t"), NULL, 10) : 0;
}

// Copies the table of a check, whose label is at `line`, without the red zone. Returns the line after the table.
static const char* copy_check_table(const char* line, unsigned long size, FILE* out) {
  const char* next = line_after(line);
  fwrite(line, 1, next - line, out);
  unsigned long written = 0;
  for (line = next; filled_bytes(line) > 0; line = next) {
    unsigned long bytes = filled_bytes(line);
    next = line_after(line);
    if (written + bytes > size && begins(line, "\t.zero\t")) {
      bytes = size > written ? size - written : 0;
      if (bytes > 0) {
        fprintf(out, "\t.zero\t%lu\n", bytes);
      }
    } else {
      fwrite(line, 1, next - line, out);
    }
    written += bytes;
  }
  return line;
}

// Writes the file without the guards of check tables. Returns how many counts of descriptors it changed.
static int copy_lean(const char* text, const struct descriptors* found, FILE* out) {
  int counts = 0;
  unsigned long size = 0;
  const char* next;
  for (const char* line = text; *line != '\0'; line = next) {
    next = line_after(line);
    if (line >= found->begin && line < found->end) {
      for (int word = 1; word < kWordsOfDescriptor; word++) {
        next = line_after(next);
      }
      if (begins(line + strlen(kWord), kCheckTable)) {
        continue;
      }
    } else if (begins(line, ".LC") && begins(next, kCheckName)) {
      next = line_after(next);
      continue;
    } else if (begins(line, "\t.size\t.Lubsan_data")) {
      const char* comma = strchr(line, ',');
      size = comma != NULL && comma < next ? strtoul(comma + 1, NULL, 10) : 0;
    } else if (begins(line, ".Lubsan_data") && size > 0) {
      next = copy_check_table(line, size, out);
      size = 0;
      continue;
    } else if (begins(line, "\t.align 32\n") && begins(next, "\t.type\t.Lubsan_data")) {
      fputs("\t.align 8\n", out);
      continue;
    } else if (sets_count(line, found)) {
      fprintf(out, "\tmovl\t$%u, %%esi\n", found->kept);
      counts++;
      continue;
    }
    fwrite(line, 1, next - line, out);
  }
  return counts;
}

// The whole file as text, or NULL.
static char* read_text(const char* path) {
  int file = open(path, O_RDONLY | O_CLOEXEC);
  struct stat status;
  if (file < 0 || fstat(file, &status) != 0) {
    return NULL;
  }
  char* text = malloc(status.st_size + 1);
  ssize_t got = text != NULL ? read(file, text, status.st_size) : -1;
  close(file);
  if (got != status.st_size) {
    free(text);
    return NULL;
  }
  text[got] = '\0';
  return text;
}

// A file in memory with the lean text, or -1 if the text stays as it is.
static int lean_file(const char* path) {
  char* text = read_text(path);
  struct descriptors found;
  if (text == NULL || !find_descriptors(text, &found)) {
    return -1;
  }
  int file = memfd_create("lean.s", 0);
  FILE* out = file >= 0 ? fdopen(dup(file), "w") : NULL;
  if (out == NULL) {
    return -1;
  }
  // One call registers the descriptors and one unregisters them.
  int right = copy_lean(text, &found, out) == 2;
  return fclose(out) == 0 && right ? file : -1;
}

int main(int count, char** arguments) {
  static char path[64];
  for (int i = 1; i < count; i++) {
    size_t length = strlen(arguments[i]);
    if (length > 2 && strcmp(arguments[i] + length - 2, ".s") == 0 && strcmp(arguments[i - 1], "-o") != 0) {
      int file = lean_file(arguments[i]);
      if (file >= 0) {
        snprintf(path, sizeof(path), "/dev/fd/%d", file);
        arguments[i] = path;
      }
    }
  }
  arguments[0] = "as";
  execvp("as", arguments);
  perror("as");
  return 1;
}
