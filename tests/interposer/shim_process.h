// Shim process: runs a program with or without the preloaded shim and collects everything it leaves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tilepress::testing {

/// A folder of its own that goes when the test ends.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct ProcessResult {
  int status = -1;  ///< as waitpid gives it
  std::string out, err;
  bool exited_with(int code) const;
  bool killed_by(int signal) const;
};

/// Runs `command`; `environment` adds to the test's own, an empty value removes the variable.
ProcessResult run_process(const std::vector<std::string>& command,
                          const std::map<std::string, std::string>& environment);

/// An X server of the test's own, on a display number the server chooses. Started at the first call, ended
/// with the test program. Empty if it does not start.
const std::string& own_display();

/// One run folder that the shim has written.
struct CapturedRun {
  std::filesystem::path path;
  std::vector<std::map<std::string, std::string>> frames, schemes;  ///< rows by column name
  std::vector<std::map<std::string, std::string>> presents, surfaces;
  std::string json;
  std::string json_text(const std::string& key) const;  ///< of a string member, at any depth; first found
  int64_t json_number(const std::string& key) const;
};

/// A program under the shim: every scheme that is quick, dumps on.
struct ShimRun {
  ProcessResult process;
  std::vector<CapturedRun> runs;  ///< by name
  std::vector<std::string> seen;  ///< lines of all .seen files, sorted
  std::string log;
};

/// Ways for the shim to get into a program.
enum class Road { kPreload, kGlvnd, kBoth };

class ShimTest {
 public:
  explicit ShimTest(Road road = Road::kPreload) : road_(road) {}
  ShimRun run(const std::vector<std::string>& command, std::map<std::string, std::string> environment = {});
  /// Bytes of a dumped frame; empty if there is none.
  std::vector<uint8_t> dump(uint32_t surface, uint64_t frame) const;

 private:
  Road road_;
  ScratchFolder folder_;
};

/// 400 windows, each resized, of four frames each, by "egl" or "glx": expects that nothing of them is left.
ShimRun soak_windows(const char* api, std::map<std::string, std::string> environment);

}  // namespace tilepress::testing
