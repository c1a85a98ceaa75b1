// Session file: lines for the launcher about this process: the entry points met, and what the shim logs.
#pragma once

#include "entry_points.h"

enum tp_way {
  TP_WAY_LINK,              // "link": the program called our export
  TP_WAY_DLSYM,             // "dlsym"
  TP_WAY_GET_PROC_ADDRESS,  // "getprocaddress"
  TP_WAY_GLVND,             // "glvnd": a call through a vendor library
  TP_WAY_UNHOOKED,          // "unhooked": all hooks of the entry point are in use
  TP_WAY_COUNT
};

// Appends "program entry way" to $TILEPRESS_SESSION/<pid>.seen, once per entry point and way. Does nothing
// where the variable is not set, and for entry points of the kinds TP_DESTROYS and TP_SERVES_OSMESA. Keeps
// errno.
//
// Without a free descriptor, the line becomes the target of a symbolic link <pid>-<number>.seen. Where the
// folder is missing, the line goes to the launcher's abstract socket "tilepress/<name of the folder>".
void tp_session_note(enum tp_entry entry, enum tp_way way);

// Appends `text` and a newline to the shim's log file (TILEPRESS_LOG_FILE). Without a free descriptor, the
// line becomes the target of a symbolic link in the session folder.
void tp_session_log(const char* text);
