// Session file: one short line per entry point and road, written with plain system calls.
#define _GNU_SOURCE
#include "session_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "entry_points.h"

static void append_line(const char* folder, const char* entry, const char* road) {
  char path[4096], line[256];
  const int path_length = snprintf(path, sizeof path, "%s/%ld.seen", folder, (long)getpid());
  const int length =
      snprintf(line, sizeof line, "%.100s %s %s\n", program_invocation_short_name, entry, road);
  if (path_length < 0 || path_length >= (int)sizeof path || length < 0 || length >= (int)sizeof line) return;
  const int file = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return;
  const ssize_t written = write(file, line, (size_t)length);
  (void)written;  // the line is a courtesy to the launcher
  close(file);
}

void tp_session_note(const char* entry, const char* road) {
  static unsigned noted[TP_ENTRY_COUNT];
  const int index = tp_find_entry(entry);
  static const char* const kQuiet[] = {"Destroy", "Terminate", "OSMesaGetProcAddress", "glfw"};
  for (int i = 0; i < 4; ++i)
    if (strstr(entry, kQuiet[i]) != NULL) return;
  const unsigned bit = road[0] == 'l' ? 1 : road[0] == 'd' ? 2 : road[0] == 'u' ? 4 : road[1] == 'e' ? 8 : 16;
  if (index < 0 || (__atomic_fetch_or(&noted[index], bit, __ATOMIC_RELAXED) & bit) != 0) return;
  const char* folder = getenv("TILEPRESS_SESSION");
  if (folder == NULL || folder[0] == 0) return;
  const int saved = errno;
  append_line(folder, entry, road);
  errno = saved;
}
