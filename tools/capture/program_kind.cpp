// Program kind: reads the ELF header and its program headers.
#include "capture/program_kind.h"

#include <elf.h>
#include <sys/stat.h>

#include <cstring>
#include <fstream>

namespace tilepress {

std::string preload_obstacle(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && (status.st_mode & (S_ISUID | S_ISGID)) != 0)
    return "is set-user-ID or set-group-ID: the loader ignores LD_PRELOAD";
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!file || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return {};
  constexpr unsigned char kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (header.e_ident[EI_CLASS] != kOwnClass) return "is a 32-bit program, and the shim is a 64-bit library";
  for (uint32_t i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    file.seekg(static_cast<std::streamoff>(header.e_phoff + uint64_t{i} * header.e_phentsize));
    file.read(reinterpret_cast<char*>(&segment), sizeof segment);
    if (!file) return {};
    if (segment.p_type == PT_INTERP) return {};
  }
  return "is statically linked: the loader preloads nothing into it";
}

}  // namespace tilepress
