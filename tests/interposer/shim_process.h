// Shim process: runs a program with or without the preloaded shim and collects what it leaves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tilepress::testing {

/// A temporary folder, removed when the test ends.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct ProcessResult {
  int status = -1;  ///< as waitpid returns it
  std::string out, err;
  bool exited_with(int code) const;
  bool killed_by(int signal) const;
};

/// Runs `command`. `environment` adds to the test's own; an empty value removes the variable.
ProcessResult run_process(const std::vector<std::string>& command,
                          const std::map<std::string, std::string>& environment);

/// Returns the display of an X server of the test's own, or "" if it does not start. The first call starts
/// the server; it ends with the test program.
const std::string& own_display();

/// One run folder that the shim has written.
struct CapturedRun {
  std::filesystem::path path;
  std::vector<std::map<std::string, std::string>> frames, schemes;  ///< rows by column name
  std::vector<std::map<std::string, std::string>> presents, surfaces;
  std::string json;
  std::string json_text(
      const std::string& key) const;  ///< the first string member of this name, at any depth
  int64_t json_number(const std::string& key) const;
};

/// A program under the shim: every scheme that is quick, and the pixels of every frame.
struct ShimRun {
  ProcessResult process;
  std::vector<CapturedRun> runs;  ///< by name
  std::vector<std::string> seen;  ///< lines of all .seen files, sorted
  std::string log;
};

/// The shim's ways into a program.
enum class Road { kPreload, kGlvnd, kBoth };

class ShimTest {
 public:
  explicit ShimTest(Road road = Road::kPreload) : road_(road) {}
  ShimRun run(const std::vector<std::string>& command, std::map<std::string, std::string> environment = {});
  /// The bytes of a frame in the newest run that has it; empty if no run has it.
  std::vector<uint8_t> dump(uint32_t surface, uint64_t frame) const;

 private:
  Road road_;
  ScratchFolder folder_;
};

/// Makes 400 windows by "egl" or "glx", resizes each, presents four frames of each, and expects no leak.
ShimRun soak_windows(const char* api, std::map<std::string, std::string> environment);

}  // namespace tilepress::testing
