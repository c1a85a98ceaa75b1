// Shim self-test: a small `tilepress run` into a temporary folder.
#include "capture/shim_self_test.h"

#include <filesystem>

#include "capture/child_process.h"
#include "capture/session_folder.h"
#include "capture/shim_launch.h"
#include "tilepress/run_lock.h"
#include "tilepress/run_reader.h"

namespace tilepress {
namespace {

constexpr unsigned kFrames = 3;
constexpr uint32_t kSide = 16;

Error fault(std::string text) {
  return {ErrorKind::kSystem, std::move(text)};
}

Result<std::string> program_beside(const std::string& library) {
  const std::filesystem::path folder = std::filesystem::path(library).parent_path();
  for (const std::filesystem::path& place : {folder, folder / "tilepress"})
    if (std::filesystem::exists(place / "tilepress-self-test"))
      return (place / "tilepress-self-test").string();
  return Error{ErrorKind::kFile, "tilepress-self-test: not found beside " + library};
}

Result<void> judge(const SessionFolder& session, const ChildEnd& child) {
  if (child.signal) return fault("the test program was ended by signal " + std::to_string(*child.signal));
  if (child.status() != 0) return fault("the test program could not present (no surfaceless EGL)");
  const auto runs = session.captured();
  if (runs.empty()) {
    const auto lines = session.log_lines();
    return fault(lines.empty() ? "no frame was seen" : lines.front());
  }
  wait_for_writer(runs.front().run_path, true);
  const Result<RunRecord> read = read_run(runs.front().run_path);
  if (!read) return read.error();
  const RunRecord& record = *read;
  if (record.frames.size() != kFrames)
    return fault(std::to_string(record.frames.size()) + " of " + std::to_string(kFrames) +
                 " frames captured");
  for (const FrameStatistics& frame : record.frames) {
    if (frame.metrics.unique_colors != 1 || frame.width != kSide)
      return fault("a frame has other pixels than the program drew");
    // Each frame has another colour: every pixel changes.
    if (frame.frame > 0 && frame.metrics.pixel_change != 1)
      return fault("a frame is a copy of the one before");
    for (const SchemeStatistics& scheme : frame.schemes)
      if (scheme.mismatched_blocks > 0) return fault("a block decoded to other pixels");
  }
  return {};
}

}  // namespace

Result<std::string> test_shim(const std::string& library, ShimRoad road) {
  const auto program = program_beside(library);
  if (!program) return program;
  TemporaryFolder folder;
  SessionFolder session;
  if (const auto made = folder.create(); !made) return made.error();
  if (const auto made = session.create(folder.path()); !made) return made.error();
  const auto preloaded = preloadable(library, folder);
  if (!preloaded) return preloaded.error();
  RunOptions options;
  options.output = folder.path();
  options.model.verify = true;
  const auto variables = shim_variables(options, session, road, *preloaded);
  if (!variables) return variables.error();
  const auto child = run_child({*program}, *variables, 60);
  if (!child) return child.error();
  if (const auto good = judge(session, *child); !good) return good.error();
  return std::to_string(kFrames) + " frames of a test program captured and decoded again";
}

}  // namespace tilepress
