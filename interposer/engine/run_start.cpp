// Run start: describes the run by what the process and its GL say of themselves.
#include "interposer/engine/run_start.h"

#include <errno.h>
#include <sys/auxv.h>

#include <fstream>
#include <string>
#include <vector>

namespace tilepress {
namespace {

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> command;
  for (std::string argument; std::getline(file, argument, '\0');) command.push_back(argument);
  return command;
}

/// The name that the program was started by. A retracer sets program_invocation_name to the name of its
/// trace.
std::string program_name() {
  const auto* path = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  std::string name = path != nullptr ? path : "";
  name.erase(0, name.rfind('/') + 1);
  return name.empty() ? program_invocation_short_name : name;
}

}  // namespace

CaptureWorker* RunStart::worker(const TilepressPresent& present, const PresentSource& source) {
  counts_.roads |= 1u << present.road;
  const std::lock_guard lock(mutex_);
  if (failed_) return nullptr;
  if (CaptureWorker* known = worker_) return known;
  RunInfo info;
  info.command = command_line();
  info.program = program_name();
  info.pid = pid_;
  info.via = present.road == TILEPRESS_ROAD_GLVND ? "glvnd" : "preload";
  info.gl_vendor = source.string(GL_VENDOR);
  info.gl_renderer = source.string(GL_RENDERER);
  info.gl_version = source.string(GL_VERSION);
  info.api = source.api();
  auto* made = new CaptureWorker(options_, info, counts_, log_);
  if (made->start()) return worker_ = made;
  log_.error("no thread to capture with");
  failed_ = true;
  delete made;
  return nullptr;
}

}  // namespace tilepress
