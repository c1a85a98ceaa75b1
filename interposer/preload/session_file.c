// Session file: one short line per entry point and road, written with plain system calls.
#include "session_file.h"

#include <stdbool.h>
#include <stddef.h>

#include "entry_points.h"
#include "environment.h"
#include "plain_text.h"
#include "system_calls.h"

extern char* program_name __asm__("program_invocation_short_name") __attribute__((weak));

static void append_line(const char* folder, const char* entry, const char* road) {
  char path_bytes[4096], line_bytes[256];
  struct tp_text path = {path_bytes, sizeof path_bytes, 0, false};
  tp_append(&path, folder);
  tp_append(&path, "/");
  tp_append_number(&path, (unsigned long)tp_process_id());
  tp_append(&path, ".seen");
  struct tp_text line = {line_bytes, sizeof line_bytes, 0, false};
  if (&program_name != NULL && program_name != NULL)
    for (size_t i = 0; i < 100 && program_name[i] != 0; ++i) tp_append_part(&line, program_name + i, 1);
  const char* const parts[] = {" ", entry, " ", road, "\n"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) tp_append(&line, parts[i]);
  if (path.cut || line.cut) return;
  const int file = tp_open(path_bytes, O_WRONLY | O_APPEND | O_CREAT, 0666);
  if (file < 0) return;
  tp_write(file, line_bytes, line.length);  // the line is a courtesy to the launcher
  tp_close(file);
}

void tp_session_note(const char* entry, const char* road) {
  static unsigned noted[TP_ENTRY_COUNT];
  const int index = tp_find_entry(entry);
  static const char kQuiet[][24] = {"Destroy", "Terminate", "OSMesaGetProcAddress", "glfw"};
  for (int i = 0; i < 4; ++i)
    if (tp_contains(entry, kQuiet[i])) return;
  const unsigned bit = road[0] == 'l' ? 1 : road[0] == 'd' ? 2 : road[0] == 'u' ? 4 : road[1] == 'e' ? 8 : 16;
  if (index < 0 || (__atomic_fetch_or(&noted[index], bit, __ATOMIC_RELAXED) & bit) != 0) return;
  const char* folder = tp_environment("TILEPRESS_SESSION");
  if (folder != NULL) append_line(folder, entry, road);
}
