// Descriptors: how the shim opens files in a process whose descriptors belong to the program.
#pragma once

#include <sys/types.h>

#include <string>

namespace tilepress {

/// Opens a file close-on-exec. The number is `lowest` or more, where the process may have such a number, and
/// never that of a standard stream. A program that has closed its standard output still writes to number 1.
/// Returns -1 with errno if the file cannot be opened so. A file that O_EXCL has just made is then removed.
int open_above_streams(const std::string& path, int flags, mode_t mode = 0666, int lowest = 3);

/// Gives the calling thread a descriptor table of its own, without a descriptor in it. The program then
/// neither closes what the thread opens nor writes to it. Returns false and changes nothing where the kernel
/// has no such call (before Linux 5.9), or where a system call filter may forbid it.
bool leave_descriptors_of_program();

}  // namespace tilepress
