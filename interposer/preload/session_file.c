// Session file: writes its lines with system calls of its own.
#define _GNU_SOURCE
#include "session_file.h"

#include <errno.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "../system_calls.h"
#include "environment.h"
#include "plain_text.h"

extern char* program_name __asm__("program_invocation_short_name") __attribute__((weak));

// Returns a descriptor, or a negative errno. Sets `made` if it created the file. The descriptor is above 2: a
// program that has closed a standard stream may still write to that number.
static int open_to_append(const char* path, bool* made) {
  const int flags = O_WRONLY | O_APPEND;
  *made = false;
  int file = tp_open(path, flags, 0);
  if (file == -ENOENT) {
    file = tp_open(path, flags | O_CREAT | O_EXCL, 0666);
    *made = file >= 0;
    if (file == -EEXIST) file = tp_open(path, flags, 0);
  }
  if (file < 0 || file > 2) return file;
  const int moved = (int)tp_system_call(SYS_fcntl, file, F_DUPFD_CLOEXEC, 3, 0);
  tp_close(file);
  return moved < 0 ? -EMFILE : moved;
}

// Returns 0, or a negative errno if the file cannot be opened.
static int append(const char* path, const struct tp_text* line) {
  bool made;
  const int file = open_to_append(path, &made);
  if (file < 0) return file;
  if (made) tp_system_call(SYS_fchmod, file, 0666, 0, 0);  // another user's process may have the same pid
  tp_write(file, line->bytes, line->length);               // on failure the launcher misses a line, no more
  tp_close(file);
  return 0;
}

// Makes a symbolic link with the line, without its newline, as target. This takes no descriptor.
static void link_line(const char* folder, struct tp_text* line, const char* extension) {
  line->bytes[line->length - 1] = 0;
  for (unsigned number = 0; number < 64; ++number) {
    char bytes[4096];
    struct tp_text path = {bytes, sizeof bytes, 0, false};
    tp_append(&path, folder);
    tp_append(&path, "/");
    tp_append_number(&path, (unsigned long)tp_process_id());
    tp_append(&path, "-");
    tp_append_number(&path, number);
    tp_append(&path, extension);
    if (path.cut) return;
    if (tp_system_call(SYS_symlinkat, (long)line->bytes, AT_FDCWD, (long)bytes, 0) != -EEXIST) return;
  }
}

// A system call filter may answer socket() with a signal.
static bool calls_are_unfiltered(void) {
  char text[4096];
  const int file = tp_open("/proc/self/status", O_RDONLY, 0);
  if (file < 0) return false;
  const long got = tp_read(file, text, sizeof text - 1);
  tp_close(file);
  text[got > 0 ? got : 0] = 0;
  return tp_contains(text, "\nSeccomp:\t0\n");
}

static void send_line(const char* folder, const struct tp_text* line) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  struct tp_text name = {address.sun_path + 1, sizeof address.sun_path - 1, 0, false};
  tp_append(&name, "tilepress/");
  tp_append(&name, tp_base_name(folder));
  if (name.cut || !calls_are_unfiltered()) return;
  const int out = (int)tp_system_call(SYS_socket, AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, 0);
  if (out < 0) return;
  const long size = (long)(offsetof(struct sockaddr_un, sun_path) + 1 + name.length);
  if (tp_system_call(SYS_connect, out, (long)&address, size, 0) == 0)
    tp_write(out, line->bytes, line->length);
  tp_close(out);
}

static void append_line(const char* folder, const char* entry, const char* way) {
  char path_bytes[4096], line_bytes[256];
  struct tp_text path = {path_bytes, sizeof path_bytes, 0, false};
  tp_append(&path, folder);
  tp_append(&path, "/");
  tp_append_number(&path, (unsigned long)tp_process_id());
  tp_append(&path, ".seen");
  struct tp_text line = {line_bytes, sizeof line_bytes, 0, false};
  if (&program_name != NULL && program_name != NULL)
    for (size_t i = 0; i < 100 && program_name[i] != 0; ++i) tp_append_part(&line, program_name + i, 1);
  const char* const parts[] = {" ", entry, " ", way, "\n"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) tp_append(&line, parts[i]);
  if (path.cut || line.cut) return;
  const int failure = append(path_bytes, &line);
  if (failure == -EMFILE || failure == -ENFILE)
    link_line(folder, &line, ".seen");
  else if (failure != 0)
    send_line(folder, &line);
}

void tp_session_note(enum tp_entry entry, enum tp_way way) {
  static const char kWays[TP_WAY_COUNT][16] = {"link", "dlsym", "getprocaddress", "glvnd", "unhooked"};
  static unsigned noted[TP_ENTRY_COUNT];  // a bit per way
  if (tp_entry_kinds[entry] == TP_DESTROYS || tp_entry_kinds[entry] == TP_SERVES_OSMESA) return;
  const unsigned bit = 1u << way;
  if ((__atomic_fetch_or(&noted[entry], bit, __ATOMIC_RELAXED) & bit) != 0) return;
  const char* folder = tp_environment("TILEPRESS_SESSION");
  if (folder != NULL) append_line(folder, tp_entry_names[entry], kWays[way]);
}

void tp_session_log(const char* text) {
  const char* path = tp_environment("TILEPRESS_LOG_FILE");
  const char* folder = tp_environment("TILEPRESS_SESSION");
  char bytes[4096];
  struct tp_text line = {bytes, sizeof bytes - 1, 0, false};
  tp_append(&line, text);
  line.size = sizeof bytes;
  tp_append(&line, "\n");
  const int failure = path != NULL ? append(path, &line) : 0;
  if ((failure == -EMFILE || failure == -ENFILE) && folder != NULL) link_line(folder, &line, ".engine");
}
