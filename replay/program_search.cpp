// Program search: walks over PATH.
#include "tilepress/program_search.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace tilepress {
namespace {

bool is_file(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool is_runnable(const std::string& path) {
  return is_file(path) && access(path.c_str(), X_OK) == 0;
}

Error why_not_runnable(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    return {errno == EACCES ? ErrorKind::kUnsupported : ErrorKind::kFile, path + ": " + std::strerror(errno)};
  return {ErrorKind::kUnsupported, path + (S_ISDIR(status.st_mode) ? ": is a folder" : ": not executable")};
}

}  // namespace

Result<std::string> find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (is_runnable(name)) return name;
    return why_not_runnable(name);
  }
  const char* variable = std::getenv("PATH");
  const std::string path = variable != nullptr ? variable : "/bin:/usr/bin";
  Error error{ErrorKind::kFile, name + ": not found"};
  for (size_t begin = 0; begin <= path.size() && !name.empty();) {
    const size_t colon = std::min(path.find(':', begin), path.size());
    const std::string folder = path.substr(begin, colon - begin);
    begin = colon + 1;
    const std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
    if (is_runnable(candidate)) return candidate;
    if (is_file(candidate)) error = why_not_runnable(candidate);
  }
  return error;
}

}  // namespace tilepress
