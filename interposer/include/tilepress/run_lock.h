// Run lock: how anyone can ask whether a run folder still has a writer, across PID and mount namespaces.
#pragma once

#include <string>

namespace tilepress {

/// A writer holds two POSIX record locks on frames.csv of its run: byte 0 for itself, byte 1 for the captured
/// program. The kernel releases both when the writer ends, however it ends. A forked child inherits neither.
///
/// POSIX locks belong to the descriptor table that took them. They go when any descriptor of the file is
/// closed in that table, so a writer must not open and close frames.csv beside the descriptor it holds.

/// Takes both locks. `frames_csv` is open for writing. Returns false where the file system has no locks.
bool hold_run_lock(int frames_csv);
/// Releases the lock for the program: it has ended, and its writer finishes the run.
void release_program_lock(int frames_csv);

/// Whether a process other than the caller writes the run in folder `path`. Returns false if the folder has
/// no frames.csv, or the file system no locks. Do not ask about a run that the caller writes itself.
bool run_is_written(const std::string& path);
/// Whether the program of that run still runs, as far as its writer knows.
bool program_is_captured(const std::string& path);

/// Waits while the run has a writer. Returns true once it has none. Returns false in two cases: the program
/// still runs after a short grace, or a writer whose program has ended makes no progress for a minute.
/// `program_ended`: the caller knows that the program has ended.
bool wait_for_writer(const std::string& path, bool program_ended);

}  // namespace tilepress
