// tilepress corpus: checks the command line and runs the Python program of replay/corpus.
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "capture/child_process.h"
#include "capture/output_folder.h"
#include "command_line.h"
#include "corpus/corpus_folder.h"
#include "temporary_folder.h"
#include "verb.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "Commands:\n"
    "  list      print the workloads that can be recorded\n"
    "  record    record workloads: trace, info, thumbnail, licences, log and checksums\n"
    "  verify    replay recorded workloads and compare the digests of their frames\n"
    "  compare   compare two recordings of workloads: frames, size, and rates within the recipe's tolerance\n"
    "  export    write recorded workloads with manifest, licences and checksums into a tar file\n"
    "\n"
    "Examples:\n"
    "  tilepress corpus list --category 3D\n"
    "  tilepress corpus record --install -o corpus gnome-calculator kubrick\n"
    "  tilepress corpus verify -o corpus\n"
    "  tilepress corpus compare --replay corpus again\n"
    "  tilepress corpus export -o corpus --archive corpus.tar\n"
    "  tilepress study paper -o out corpus/*/*.trace\n"
    "\n"
    "Each program runs on a private X server with its own HOME. A workload that fails is named in one line, and\n"
    "the others go on.\n"
    "Exit status: 1 if a workload failed or differs.\n";

struct CorpusOptions {
  std::string command, category, output = "tilepress-corpus", archive, recipes, keep;
  std::vector<std::string> names;
  unsigned frames = 0;
  bool install = false, replay = false, quiet = false;
};

/// Options that only one command takes.
struct OwnOption {
  const char* option;
  const char* command;
};
constexpr OwnOption kOwnOptions[] = {
    {"--archive", "export"}, {"--frames", "record"}, {"--install", "record"},
    {"--keep-failed", "record"}, {"--replay", "compare"}};

std::optional<int> parse_options(int argc, char** argv, CorpusOptions& options) {
  CLI::App app("Lists, records, verifies, compares and exports workloads of free programs.");
  app.footer(kExamples);
  app.add_option("COMMAND", options.command, "list, record, verify, compare or export")
      ->required()
      ->check(CLI::IsMember({"list", "record", "verify", "compare", "export"}));
  app.add_option("NAME", options.names, "Workloads (default: all). For compare: two folders, then workloads")->type_name("...");
  app.add_option("-o,--output", options.output, "Folder of the recorded workloads (default: " + options.output + ")")
      ->type_name("DIR");
  app.add_option("--category", options.category, "Only the workloads of this category: UI, 2D or 3D")
      ->type_name("UI|2D|3D")
      ->check(CLI::IsMember({"UI", "2D", "3D"}));
  app.add_option("--recipes", options.recipes, "Folder of recipes (default: those of tilepress)")->type_name("DIR");
  app.add_option("--archive", options.archive, "For export: the tar file (default: DIR.tar)")->type_name("FILE");
  app.add_option("--frames", options.frames, "For record: frames of each workload (default: as the recipe says)")
      ->type_name("N")
      ->check(CLI::Range(2u, 2000u));
  app.add_flag("--install", options.install, "For record: install the Debian packages of the workloads first");
  app.add_option("--keep-failed", options.keep, "For record: keep the files of failed workloads here")
      ->type_name("DIR");
  app.add_flag("--replay", options.replay, "For compare: replay both recordings and compare their frames too");
  app.add_flag("-q,--quiet", options.quiet, "Print no progress");
  if (const auto status = parse_command_line(app, argc, argv)) return status;
  for (const OwnOption& own : kOwnOptions)
    if (app.count(own.option) > 0 && options.command != own.command)
      return fail(kExitUsage, std::string(own.option) + " is an option of corpus " + own.command);
  if (options.command == "compare" && options.names.size() < 2)
    return fail(kExitUsage, "corpus compare takes two folders of recorded workloads (see tilepress corpus --help)");
  return std::nullopt;
}

std::vector<std::string> program_line(const CorpusOptions& options, const std::string& folder,
                                      const std::string& listing) {
  const auto absolute = [](const std::string& path) { return absolute_folder(path); };
  const std::string recipes = options.recipes.empty() ? folder + "/recipes" : absolute(options.recipes);
  const std::string archive =
      options.archive.empty() ? absolute(options.output) + ".tar" : fs::absolute(options.archive).string();
  std::vector<std::string> words = {folder + "/corpus.py", "--recipes=" + recipes,
                                    "--output=" + absolute(options.output), "--archive=" + archive,
                                    "--listing=" + listing};
  if (!options.category.empty()) words.push_back("--category=" + options.category);
  if (!options.keep.empty()) words.push_back("--keep=" + absolute(options.keep));
  if (options.frames > 0) words.push_back("--frames=" + std::to_string(options.frames));
  if (options.install) words.push_back("--install");
  if (options.replay) words.push_back("--replay");
  if (options.quiet) words.push_back("--quiet");
  words.insert(words.end(), {"--", options.command});
  words.insert(words.end(), options.names.begin(), options.names.end());
  return words;
}

/// Debian's python3 first: another one on PATH may lack Debian's modules.
Result<ChildEnd> run_python(std::vector<std::string> words) {
  std::error_code code;
  const std::string self = fs::read_symlink("/proc/self/exe", code).string();
  const std::string python = fs::exists("/usr/bin/python3", code) ? "/usr/bin/python3" : "python3";
  words.insert(words.begin(), python);
  return run_child(words, {{"TILEPRESS", self}, {"PYTHONDONTWRITEBYTECODE", "1"}});
}

/// Copies the program's list to standard output.
void print_listing(const std::string& path) {
  FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return;
  char text[4096];
  for (size_t count; (count = std::fread(text, 1, sizeof text, file)) > 0;) std::fwrite(text, 1, count, stdout);
  std::fclose(file);
}

}  // namespace

int verb_corpus(int argc, char** argv) {
  CorpusOptions options;
  if (const auto status = parse_options(argc, argv, options)) return *status;
  const auto folder = find_corpus_folder();
  if (!folder) return fail(kExitFailed, folder.error());
  TemporaryFolder temporary;
  if (const auto made = temporary.create(); !made) return fail(kExitFailed, made.error());
  const std::string listing = temporary.path() + "/list";
  const auto end = run_python(program_line(options, *folder, listing));
  if (!end) return fail(kExitFailed, end.error());
  print_listing(listing);
  return end->status();
}

}  // namespace tilepress
