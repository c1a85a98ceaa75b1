// Packed file: a .tpk file on disk, or the verb that takes what is none.
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "frames/packed_reader.h"
#include "input_kind.h"

namespace tilepress {

Result<std::unique_ptr<PackedFile>> open_packed_file(const std::string& path) {
  auto file = std::make_unique<PackedFile>();
  file->path = path;
  file->stream.open(path, std::ios::binary);
  if (!file->stream) return Error{ErrorKind::kFile, path + ": " + std::strerror(errno)};
  const auto refuse = [&](const Error& error) {
    return Error{error.kind, path + ": " + error.text + verb_hint(path, "unpack")};
  };
  if (std::filesystem::is_directory(path)) return refuse({ErrorKind::kFile, "is a folder"});
  if (const auto opened = file->reader.open(file->stream); !opened) return refuse(opened.error());
  return file;
}

}  // namespace tilepress
