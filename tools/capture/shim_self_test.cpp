// Shim self-test: as `tilepress run`, into a folder that goes again.
#include "capture/shim_self_test.h"

#include <filesystem>

#include "capture/child_process.h"
#include "capture/session_folder.h"
#include "temporary_folder.h"
#include "tilepress/run_lock.h"
#include "tilepress/run_reader.h"

namespace tilepress {
namespace {

constexpr unsigned kFrames = 3;
constexpr uint32_t kSide = 16;

std::string program_beside(const std::string& library) {
  const std::filesystem::path folder = std::filesystem::path(library).parent_path();
  for (const std::filesystem::path& place : {folder, folder / "tilepress"})
    if (std::filesystem::exists(place / "tilepress-self-test"))
      return (place / "tilepress-self-test").string();
  return {};
}

std::string judge(const SessionFolder& session, const ChildEnd& child) {
  if (child.signal) return "the test program was ended by signal " + std::to_string(*child.signal);
  if (child.status() != 0) return "the test program could not present (no surfaceless EGL)";
  const auto runs = session.captured();
  if (runs.empty()) {
    const auto lines = session.log_lines();
    return lines.empty() ? "no frame was seen" : lines.front();
  }
  wait_for_writer(runs.front().run_path, true);
  const auto read = read_run(runs.front().run_path);
  if (!read) return read.error().text;
  const RunRecord& record = *read;
  if (record.frames.size() != kFrames)
    return std::to_string(record.frames.size()) + " of " + std::to_string(kFrames) + " frames captured";
  for (const FrameStatistics& frame : record.frames) {
    if (frame.metrics.unique_colors != 1 || frame.width != kSide)
      return "a frame has other pixels than were drawn";
    // Each frame has another colour: every pixel changes.
    if (frame.frame > 0 && frame.metrics.pixel_change != 1) return "a frame is the one before";
    for (const SchemeStatistics& scheme : frame.schemes)
      if (scheme.mismatched_blocks > 0) return "a block does not decode to itself";
  }
  return {};
}

}  // namespace

SelfTestResult test_shim(const std::string& library, ShimRoad road) {
  SelfTestResult result;
  TemporaryFolder folder;
  SessionFolder session;
  const std::string program = program_beside(library);
  if (program.empty()) {
    result.detail = "tilepress-self-test: not found beside " + library;
    return result;
  }
  if (!folder.create(result.detail) || !session.create(folder.path(), result.detail)) return result;
  const std::string preloaded = preloadable(library, folder, result.detail);
  RunOptions options;
  options.output = folder.path();
  options.log_file = session.log_path();
  options.model.verify = true;
  auto environment = to_environment(options);
  environment["TILEPRESS_SESSION"] = session.path();
  if (const auto added = add_shim_environment(environment, road, preloaded); !added) {
    result.detail = added.error().text;
    return result;
  }
  StartFailure failure{};
  const auto child = run_child({program}, environment, failure, 60);
  result.detail = child ? judge(session, *child) : failure.reason;
  result.passed = result.detail.empty();
  if (result.passed)
    result.detail = std::to_string(kFrames) + " frames of a test program captured and decoded again";
  return result;
}

}  // namespace tilepress
