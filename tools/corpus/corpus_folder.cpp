// Corpus folder: relative to /proc/self/exe, so that an installed tree may be moved.
#include "corpus/corpus_folder.h"

#include <filesystem>

namespace tilepress {

Result<std::string> find_corpus_folder() {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path prefix = fs::read_symlink("/proc/self/exe", code).parent_path().parent_path();
  const fs::path folder = prefix / "share/tilepress/corpus";
  if (fs::is_regular_file(folder / "corpus.py", code)) return folder.string();
  return Error{ErrorKind::kFile, folder.string() + ": the corpus is not installed there"};
}

}  // namespace tilepress
