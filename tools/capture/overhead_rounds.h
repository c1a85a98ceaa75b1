// Overhead rounds: a program run with and without capture, by turns (--measure-overhead).
#pragma once

#include <string>

#include "capture/program_launch.h"

namespace tilepress {

/// Runs the program `rounds` times with and `rounds` times without capture. Writes overhead.csv, or the first
/// free name of overhead-2.csv, …, into the output folder. Returns the exit status. `program_path` is the
/// program's file.
int measure_overhead(LaunchOptions options, unsigned rounds, const std::string& program_path);

}  // namespace tilepress
