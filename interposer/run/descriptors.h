// Descriptors: how the shim opens files in a process whose descriptors belong to the program.
#pragma once

#include <sys/types.h>

#include <string>

namespace tilepress {

/// Opens a file close-on-exec. The number is `lowest` or more where the limits of the process allow it, and
/// never that of a standard stream: a program that has closed its standard output still writes to number 1.
/// Returns -1 with errno on failure, and removes a file that O_EXCL has just made.
int open_above_streams(const std::string& path, int flags, mode_t mode = 0666, int lowest = 3);

/// Gives the calling thread a descriptor table of its own, without a descriptor in it. The program then
/// neither closes what the thread opens nor writes to it. Returns false and changes nothing where the kernel
/// has no such call (before Linux 5.9), or where a system call filter may forbid it.
bool leave_descriptors_of_program();

}  // namespace tilepress
