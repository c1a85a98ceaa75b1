// Replay batch: a few threads that each wait for a retracer.
#include "tilepress/replay_batch.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace tilepress {
namespace {

constexpr std::chrono::milliseconds kTickPeriod{100};

bool is_measured(const ReplayResult& result) {
  return (result.status == ReplayStatus::kDone || result.status == ReplayStatus::kKept) &&
         result.run.measured_frames > 0;
}

/// Sums of 1/rate of one scheme.
struct MeanSums {
  uint64_t traces = 0;
  double inverse = 0, inverse_payload = 0;
};

MeanSums sum_over(const std::vector<std::unique_ptr<TraceReplay>>& replays, const std::string& category,
                  const std::string& scheme) {
  MeanSums sums;
  for (const auto& replay : replays) {
    if (!is_measured(replay->result()) || (!category.empty() && replay->input().category != category))
      continue;
    const RunRecord& run = replay->result().run;
    const auto found = std::find(run.scheme_names.begin(), run.scheme_names.end(), scheme);
    if (found == run.scheme_names.end()) continue;
    const SchemeStatistics& total = run.totals[static_cast<size_t>(found - run.scheme_names.begin())];
    ++sums.traces;
    sums.inverse += 1 / total.rate();
    sums.inverse_payload += 1 / total.rate_payload();
  }
  return sums;
}

void append_once(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

}  // namespace

ReplayBatch::ReplayBatch(const std::vector<ReplayInput>& inputs, const ReplayOptions& options) {
  for (const ReplayInput& input : inputs) replays_.push_back(std::make_unique<TraceReplay>(input, options));
}

void ReplayBatch::run(unsigned jobs, const std::atomic<bool>& stop,
                      const std::function<void(const BatchProgress&)>& tick) {
  std::vector<TraceReplay*> ready;
  BatchProgress progress;
  for (const auto& replay : replays_) {
    if (stop) return;
    if (replay->prepare()) ready.push_back(replay.get());
  }
  for (const TraceReplay* replay : ready) progress.frames_wanted += replay->result().frames_wanted;

  std::atomic<size_t> next{0};
  std::atomic<unsigned> working{static_cast<unsigned>(std::min<size_t>(std::max(jobs, 1u), ready.size()))};
  std::vector<std::thread> workers;
  for (unsigned i = working; i > 0; --i)
    workers.emplace_back([&] {
      for (size_t index = next++; index < ready.size() && !stop; index = next++) ready[index]->run(stop);
      --working;
    });
  // Workers wait for processes, so a short sleep here costs nothing and ends with the last of them.
  auto told = std::chrono::steady_clock::now();
  while (working > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (std::chrono::steady_clock::now() - told < kTickPeriod) continue;
    told = std::chrono::steady_clock::now();
    progress.frames_done = 0;
    for (const TraceReplay* replay : ready) progress.frames_done += replay->frames_done();
    tick(progress);
  }
  for (std::thread& worker : workers) worker.join();
  progress.frames_done = 0;
  for (const TraceReplay* replay : ready) progress.frames_done += replay->frames_done();
  tick(progress);
}

std::vector<CategoryMean> category_means(const std::vector<std::unique_ptr<TraceReplay>>& replays) {
  std::vector<std::string> categories, schemes;
  for (const auto& replay : replays) {
    if (!is_measured(replay->result())) continue;
    if (!replay->input().category.empty()) append_once(categories, replay->input().category);
    for (const std::string& scheme : replay->result().run.scheme_names) append_once(schemes, scheme);
  }
  categories.emplace_back();
  std::vector<CategoryMean> means;
  for (const std::string& category : categories) {
    for (const std::string& scheme : schemes) {
      const MeanSums sums = sum_over(replays, category, scheme);
      const auto count = static_cast<double>(sums.traces);
      if (sums.traces > 0)
        means.push_back({category, scheme, sums.traces, count / sums.inverse, count / sums.inverse_payload});
    }
  }
  return means;
}

}  // namespace tilepress
