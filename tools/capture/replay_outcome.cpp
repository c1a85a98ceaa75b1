// Replay outcome: lists of traces by status.
#include "capture/replay_outcome.h"

#include <algorithm>

#include "exit_status.h"
#include "frames/dumped_frames.h"
#include "input_kind.h"
#include "printable.h"
#include "streams/messages.h"

namespace tilepress {

static bool is_good(const ReplayResult& result) {
  return result.status == ReplayStatus::kDone || result.status == ReplayStatus::kKept;
}

std::string interruption_text(const ReplayBatch& batch) {
  std::string done, cut, waiting;
  bool interrupted = false;
  const auto add = [](std::string& list, const std::string& text) {
    list += (list.empty() ? "" : ", ") + text;
  };
  for (const auto& replay : batch.replays()) {
    const ReplayResult& result = replay->result();
    const std::string& path = replay->input().path;
    interrupted |= result.status == ReplayStatus::kInterrupted;
    if (result.status == ReplayStatus::kWaiting)
      add(waiting, path);
    else if (is_good(result))
      add(done, path);
    else
      add(cut, path + " " + result.reason);
  }
  if (!interrupted && waiting.empty()) return {};
  std::string text;
  if (!done.empty()) text += "done: " + done;
  if (!cut.empty()) text += (text.empty() ? "" : "; ") + cut;
  if (!waiting.empty()) text += (text.empty() ? "" : "; ") + std::string("not replayed: ") + waiting;
  return text;
}

bool convert_all_dumped_frames(const ReplayBatch& batch) {
  bool good = true;
  for (const auto& replay : batch.replays()) {
    const std::string& path = replay->result().run.path;
    if (path.empty()) continue;
    const auto converted = convert_dumped_frames(path);
    if (!converted) fail(kExitFailed, converted.error());
    good &= static_cast<bool>(converted);
  }
  return good;
}

int report_failures(const ReplayBatch& batch, const std::vector<std::string>& named) {
  uint64_t captured = 0;
  bool failed = !convert_all_dumped_frames(batch), nothing = false;
  for (const auto& replay : batch.replays()) {
    const ReplayResult& result = replay->result();
    captured += result.frames_captured;
    if (is_good(result)) continue;
    (result.status == ReplayStatus::kNothingCaptured ? nothing : failed) = true;
    const std::string& path = replay->input().path;
    if (std::find(named.begin(), named.end(), path) != named.end()) continue;
    fail(kExitFailed, path + ": " +
                          (result.status == ReplayStatus::kWaiting ? "not replayed" : result.reason) +
                          verb_hint(path, "replay"));
    show(last_words(result.retracer_lines));
  }
  if (nothing && !failed && captured == 0) return kExitNothingCaptured;
  return failed || nothing ? kExitFailed : kExitDone;
}

}  // namespace tilepress
