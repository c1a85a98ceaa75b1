// Session mark: one line, "session pid namespace". It has the name of the session, because the path can
// differ between mount namespaces.
#include "tilepress/session_mark.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "run/descriptors.h"

namespace tilepress {

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
