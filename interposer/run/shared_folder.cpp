// Shared folder: mkdir is the test for a free name. A test before mkdir would leave time for another process.
#include "tilepress/shared_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "run/descriptors.h"
#include "tilepress/file_error.h"

namespace tilepress {

void share_like_parent(const std::string& folder, unsigned extra_mode) {
  struct stat parent {};
  const std::string parent_path = std::filesystem::path(folder).parent_path().string();
  if (stat(parent_path.c_str(), &parent) != 0) return;
  // Never through a link: another user of the parent may have put a link there.
  const int file = open_above_streams(folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW);
  if (file < 0) return;
  if (fchown(file, parent.st_uid, parent.st_gid) != 0 &&
      fchown(file, static_cast<uid_t>(-1), parent.st_gid) != 0) {
    // The owner stays. The mode below still helps.
  }
  fchmod(file, (parent.st_mode & 01777) | extra_mode);
  close(file);
}

Result<std::string> make_run_folder(const std::string& output, const std::string& name) {
  std::error_code code;
  std::filesystem::create_directories(output, code);
  if (code) return Error{ErrorKind::kFile, output + ": " + code.message()};
  const std::string stem = output + "/" + name;
  std::string path = stem;
  for (int suffix = 2; mkdir(path.c_str(), 0777) != 0; ++suffix) {
    if (errno != EEXIST) return file_error(output);
    path = stem + "-" + std::to_string(suffix);
  }
  if (geteuid() == 0) share_like_parent(path);
  return path;
}

}  // namespace tilepress
