// Nothing captured: one message, and lines with the evidence.
#include "capture/nothing_captured.h"

#include <fmt/format.h>

#include "capture/program_kind.h"
#include "exit_status.h"
#include "streams/messages.h"

namespace tilepress {

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
