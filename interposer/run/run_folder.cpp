// Run folder: mkdir is the test for a free name, because a test before it would leave time for another
// process. The mark is a line "session pid namespace". It has the session's name, because the path can differ
// between mount namespaces.
#include "tilepress/run_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

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

uint64_t own_pid_namespace() {
  struct stat status {};
  return stat("/proc/self/ns/pid", &status) == 0 ? status.st_ino : 0;
}

void write_session_mark(const std::string& run_path, int64_t pid) {
  const char* session = std::getenv("TILEPRESS_SESSION");
  if (session == nullptr || *session == 0) return;
  const std::string path = session;
  const std::string line = path.substr(path.rfind('/') + 1) + " " + std::to_string(pid) + " " +
                           std::to_string(own_pid_namespace()) + "\n";
  const int file = open_above_streams(run_path + "/" + kSessionMarkFile, O_WRONLY | O_CREAT | O_EXCL);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = write(file, line.data(), line.size());
  close(file);
}

std::optional<SessionMark> read_session_mark(const std::string& run_path) {
  const std::string path = run_path + "/" + kSessionMarkFile;
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  char text[256];
  const ssize_t got = read(file, text, sizeof text);
  close(file);
  std::istringstream words(std::string(text, static_cast<size_t>(std::max<ssize_t>(got, 0))));
  SessionMark mark;
  if (words >> mark.session >> mark.pid >> mark.pid_namespace) return mark;
  return std::nullopt;
}

}  // namespace tilepress
