// Verb: one sub-command of tilepress, and the functions behind all of them.
#pragma once

#include "streams/ending_signals.h"

namespace tilepress {

/// One line of the command's table. `run` gets argv with the verb's name at [0] and returns the exit status.
struct Verb {
  const char* name;
  const char* synopsis;  ///< one line for `tilepress help`
  int (*run)(int argc, char** argv);
  OnSignal on_signal = OnSignal::kEndAtOnce;
};

int verb_bench(int argc, char** argv);
int verb_compare(int argc, char** argv);
int verb_compose(int argc, char** argv);
int verb_corpus(int argc, char** argv);
int verb_cost(int argc, char** argv);
int verb_doctor(int argc, char** argv);
int verb_export(int argc, char** argv);
int verb_frames(int argc, char** argv);
int verb_info(int argc, char** argv);
int verb_report(int argc, char** argv);
int verb_memory_trace(int argc, char** argv);
int verb_pack(int argc, char** argv);
int verb_record(int argc, char** argv);
int verb_replay(int argc, char** argv);
int verb_run(int argc, char** argv);
int verb_schemes(int argc, char** argv);
int verb_study(int argc, char** argv);
int verb_summary(int argc, char** argv);
int verb_top(int argc, char** argv);
int verb_unpack(int argc, char** argv);
int verb_vectors(int argc, char** argv);
int verb_view(int argc, char** argv);

}  // namespace tilepress
