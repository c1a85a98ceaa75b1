// File error: an errno about a file as an Error.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Returns "path: reason". The kind is kExists for EEXIST and kFile for any other number.
inline Error file_error(const std::string& path, int number = errno) {
  return {number == EEXIST ? ErrorKind::kExists : ErrorKind::kFile, path + ": " + std::strerror(number)};
}

}  // namespace tilepress
