// Ended runs: counted by their folders.
#include "live/ended_runs.h"

#include <filesystem>

#include "counted.h"
#include "input_kind.h"
#include "live/running_captures.h"
#include "report/run_batch.h"
#include "way_out.h"

namespace tilepress {

std::string ended_runs_text(const std::string& folder) {
  if (!find_running_captures({folder}).empty()) return {};
  const auto runs = find_runs({folder});
  if (!runs) return {};
  const bool one = runs->size() == 1;
  return counted(runs->size(), "ended run") + (one ? " is" : " are") + " there; `tilepress report " +
         shell_word(folder) + " -o report.html` shows " + (one ? "it" : "them");
}

Result<void> check_capture_folders(const std::vector<std::string>& folders) {
  std::error_code code;
  for (const std::string& folder : folders)
    if (std::filesystem::exists(folder, code) && !std::filesystem::is_directory(folder, code))
      return Error{ErrorKind::kFile, folder + ": not a folder" + verb_hint(folder)};
  return {};
}

}  // namespace tilepress
