// Nothing captured: one message, and lines with the evidence.
#include "capture/nothing_captured.h"

#include <elf.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cstring>
#include <fstream>

#include "exit_status.h"
#include "streams/messages.h"
#include "way_out.h"

namespace tilepress {

/// Returns why LD_PRELOAD cannot reach `path` (statically linked, another word size, set-user-ID); empty if
/// it can.
static std::string preload_obstacle(const std::string& path) {
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

int report_nothing_captured(const LaunchOptions& options, const SessionFolder& session, uint64_t frames_seen,
                            const std::string& program_path) {
  std::string line = options.program.front() + ": no frame captured";
  if (frames_seen > 0)
    line +=
        fmt::format(": {} presented, none of them asked for, readable and in a modelled format", frames_seen);
  fail(kExitNothingCaptured, line);
  std::string text =
      "  looked for: eglSwapBuffers, eglSwapBuffersWithDamageKHR and EXT, glXSwapBuffers and the like,\n"
      "  linked, by dlsym, or by eglGetProcAddress and glXGetProcAddress\n";
  if (options.run.triggers == 0)
    text += "  if the program draws and presents nothing, try --trigger finish,flush,readpixels\n";
  text += display_hint("run");
  const std::vector<std::string> seen = session.seen(), unreached = session.seen_from_afar();
  for (const auto* entries : {&seen, &unreached})
    for (const std::string& entry : *entries) text += "  seen: " + entry + "\n";
  const std::string& folder = options.run.output;
  if (!unreached.empty())
    text += fmt::format(
        "  these processes could not write to the session folder in {}:\n"
        "  they have another root, /tmp or user.\n"
        "  Use -o with a folder that they see under the same path and may write\n",
        folder);
  else if (seen.empty())
    text += fmt::format(
        "  seen: nothing: no process that reaches the session folder in {} asked for any of them.\n"
        "  A process in a container, or with another root, /tmp or user, may not reach it\n",
        folder);
  if (const std::string why = preload_obstacle(program_path); !why.empty())
    text += fmt::format("  {}: {}\n", program_path, why);
  show(text);
  return kExitNothingCaptured;
}

}  // namespace tilepress
