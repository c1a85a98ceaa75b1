/* Process size: what the soak programs print to show that nothing is lost. */
#pragma once

#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

static inline long resident_kib(void) {
  long pages = 0, resident = 0;
  FILE* file = fopen("/proc/self/statm", "r");
  if (file == NULL || fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = -1;
  if (file != NULL) fclose(file);
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

/* Entries of a folder of /proc/self, without the two dots. */
static inline int entries_of(const char* path) {
  int count = -2;
  DIR* folder = opendir(path);
  while (folder != NULL && readdir(folder) != NULL) ++count;
  if (folder != NULL) closedir(folder);
  return count;
}

static inline void print_process_size(void) {
  const int descriptors = entries_of("/proc/self/fd") - 1; /* the folder's own */
  printf("%ld KiB, %d descriptors, %d threads\n", resident_kib(), descriptors, entries_of("/proc/self/task"));
  fflush(stdout);
}
