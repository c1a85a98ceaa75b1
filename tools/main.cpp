// The tilepress command: finds the verb in the table and calls its function.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.h"
#include "streams/standard_streams.h"
#include "tilepress/nearest_word.h"
#include "tilepress/simd.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr Verb kVerbs[] = {
    {"run", "run a program and capture every frame it presents", verb_run, OnSignal::kVerbsOwn},
    {"frames", "compress a sequence of images, movies or raw frames", verb_frames, OnSignal::kEndInOrder},
    {"replay", "replay recorded traces without a display and capture their frames", verb_replay,
     OnSignal::kEndInOrder},
    {"study", "model every configuration of a study on many inputs, and draw its figures", verb_study,
     OnSignal::kEndInOrder},
    {"corpus", "list, record, verify and export workloads of free programs", verb_corpus, OnSignal::kVerbsOwn},
    {"record", "record a program into a trace", verb_record, OnSignal::kVerbsOwn},
    {"info", "print what recorded traces hold", verb_info},
    {"bench", "measure the speed of each scheme, memcpy and LZ4", verb_bench},
    {"report", "write an HTML page about one run or many", verb_report},
    {"summary", "print the rates of finished runs and their means", verb_summary},
    {"compare", "compare two runs, with an exit status for regressions", verb_compare},
    {"pack", "compress images into a file of compressed surfaces", verb_pack},
    {"unpack", "restore the images of a packed file, or read a part and count bursts", verb_unpack},
    {"compose", "compute the read bandwidth of several packed surfaces shown at once", verb_compose},
    {"vectors", "write test vectors for hardware, block by block", verb_vectors},
    {"memory-trace", "write the memory requests of a run for a DRAM simulator", verb_memory_trace},
    {"cost", "print storage, area, speed and energy of the DCP structures", verb_cost},
    {"top", "watch running captures", verb_top, OnSignal::kVerbsOwn},
    {"view", "show the last frame of a running capture in a window", verb_view, OnSignal::kVerbsOwn},
    {"export", "write runs as gem5 statistics or JSON lines", verb_export},
    {"schemes", "list the schemes and their options", verb_schemes},
    {"doctor", "check this machine and name missing packages", verb_doctor},
};

constexpr const char* kHeadText =
    "tilepress: framebuffer compression statistics of running GL programs, frame by frame.\n"
    "\n"
    "Usage: tilepress VERB [options] ...\n"
    "\n"
    "Verbs:\n";

constexpr const char* kTailText =
    "  help         show this, or with a verb: the verb's options\n"
    "\n"
    "Examples:\n"
    "  tilepress run -o out -- glmark2-es2 -b desktop        capture a program, the paper's schemes\n"
    "  tilepress run -s vdcp -s vdcp:fvc=128 -- glxgears     two configurations side by side\n"
    "  tilepress run --frames 100-199 --verify -- ./game     some frames, proven lossless\n"
    "  tilepress frames -o out shots/*.png                   a sequence of images\n"
    "  tilepress frames -o - shots/*.png | head              its rows on standard output\n"
    "\n"
    "A run leaves frames.csv, schemes.csv and run.json in its folder; a summary goes to standard error.\n"
    "Exit status: 0 done, 1 a check or an input failed, 2 usage, 3 nothing captured; `run` passes on the\n"
    "program's own (128+n for a signal), or 125 tilepress failed, 126 not executable, 127 not found.\n";

const Verb* find_verb(const char* name) {
  for (const Verb& verb : kVerbs)
    if (std::strcmp(verb.name, name) == 0) return &verb;
  return nullptr;
}

int unknown_word(const std::string& word) {
  std::vector<std::string_view> names = {"help", "--help", "--version"};
  for (const Verb& verb : kVerbs) names.emplace_back(verb.name);
  const char* kind = word.starts_with("-") ? "unknown option '" : "unknown verb '";
  return fail(kExitUsage, kind + word + "'" + nearest_hint(word, names, "see tilepress help"));
}

int show_help() {
  std::fputs(kHeadText, stdout);
  for (const Verb& verb : kVerbs) std::printf("  %-12s %s\n", verb.name, verb.synopsis);
  std::fputs(kTailText, stdout);
  return kExitDone;
}

/// TILEPRESS_SIMD=TARGET chooses the instruction set. The results are the same for every target.
std::optional<int> force_simd() {
  const char* name = std::getenv("TILEPRESS_SIMD");
  if (name == nullptr || *name == '\0' || force_simd_target(name)) return {};
  const auto targets = simd_targets();
  const std::vector<std::string_view> known(targets.begin(), targets.end());
  return fail(kExitUsage, std::string("TILEPRESS_SIMD=") + name + ": this machine has " + listed_words(known, ", ") +
                              nearest_hint(name, known));
}

int dispatch(int argc, char** argv) {
  if (const auto status = force_simd()) return *status;
  if (argc < 2) return fail(kExitUsage, "no verb given (see tilepress help)");
  const std::string word = argv[1];
  if (word == "--version" || word == "version") {
    std::printf("tilepress %s\n", TILEPRESS_VERSION);
    return kExitDone;
  }
  if (word == "--help" || word == "-h" || (word == "help" && argc == 2)) return show_help();
  if (word == "help") {
    const Verb* verb = find_verb(argv[2]);
    if (verb == nullptr) return unknown_word(argv[2]);
    char help[] = "--help";
    char* help_argv[] = {argv[2], help, nullptr};
    return verb->run(2, help_argv);
  }
  const Verb* verb = find_verb(word.c_str());
  if (verb == nullptr) return unknown_word(word);
  choose_on_signal(verb->on_signal);
  return verb->run(argc - 1, argv + 1);
}

/// Verbs throw nothing themselves. An exception of a library ends in one line.
int run_command(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const std::exception& error) {
    return fail(kExitFailed, error.what());
  }
}

/// Returns the exit status after writing out what the verb printed.
int end_with(int status) {
  const bool reported = standard_output_has_failed();
  const auto flushed = flush_standard_output();
  if (flushed || noted_signal() != 0) return status;
  return reported ? kExitFailed : fail(kExitFailed, flushed.error());
}

}  // namespace
}  // namespace tilepress

int main(int argc, char** argv) {
  tilepress::guard_standard_streams();
  tilepress::open_messages();
  return tilepress::end_with(tilepress::run_command(argc, argv));
}
