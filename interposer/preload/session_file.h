// Session file: tells the launcher which entry points this process looked up or called, and by which road.
#pragma once

// Appends "program entry road" to $TILEPRESS_SESSION/<pid>.seen, once per entry and road; nothing where the
// variable is not set. `entry` is a name of tp_entry_names; those that end something are not told. Keeps
// errno. road: link, dlsym, getprocaddress, or glvnd, unhooked (all hooks of the entry are in use).
//
// Without a free descriptor the line becomes the target of a symbolic link <pid>-<number>.seen. Where the
// folder is not there, the line goes to the launcher's abstract socket "tilepress/<name of the folder>".
void tp_session_note(const char* entry, const char* road);

// Appends `text` and a newline to the log file of the shim (TILEPRESS_LOG_FILE). Without a free
// descriptor the line becomes the target of a symbolic link in the session folder.
void tp_session_log(const char* text);
