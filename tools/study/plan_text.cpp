// Plan text: frames are counted, times are estimated from a small picture.
#include "plan_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "counted.h"
#include "study/study_task.h"
#include "study/workload_size.h"
#include "tilepress/surface_engine.h"

namespace tilepress {
namespace {

/// What llvmpipe takes for a pixel of a simple scene, readback and compression included, on one core.
constexpr double kRenderNsPerPixel = 20;

/// Nanoseconds per pixel for all configurations together, measured on a picture of areas and shades.
double model_ns_per_pixel(const std::vector<SchemeSpec>& configurations, const ModelOptions& model) {
  constexpr uint32_t kSide = 256, kFrames = 3;
  std::vector<uint32_t> pixels(kSide * kSide);
  for (uint32_t i = 0; i < pixels.size(); ++i)
    pixels[i] = 0xFF000000 | (i % kSide < kSide / 2 ? i / 4096 * 4099 : i * 2654435761u >> 20);
  const SurfaceView view{.top_row = reinterpret_cast<const std::byte*>(pixels.data()),
                         .pitch_bytes = kSide * 4,
                         .width = kSide,
                         .height = kSide};
  SurfaceEngine engine(configurations, model);
  FrameStatistics statistics;
  uint64_t sum_ns = 0;
  for (uint32_t i = 0; i < kFrames; ++i) {
    engine.process(view, statistics);
    if (i > 0) sum_ns += statistics.encode_ns;  // the first frame has no tables
  }
  return static_cast<double>(sum_ns) / (kFrames - 1) / static_cast<double>(pixels.size());
}

struct TaskCounts {
  uint64_t tasks = 0;
  size_t results = 0;  ///< when the tasks are done
  size_t stored = 0;   ///< of these, results that the folder has
};

TaskCounts count_tasks(const StudyPlan& plan, size_t workload, const StudyOptions& options) {
  const auto record = load_workload_record(options.folder, plan.workloads[workload].name);
  const bool has_frames = record && record->has_frames();
  TaskCounts counts;
  for (const StudyTask& task : plan.tasks) {
    if (task.workload != workload) continue;
    ++counts.tasks;
    counts.results += result_count(task);
    if (has_frames) counts.stored += result_count(task) - missing_results(plan, task, *record, options);
  }
  return counts;
}

std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string plan_text(const StudyPlan& plan, const StudyOptions& options) {
  size_t width = 8;
  for (const Workload& workload : plan.workloads) width = std::max(width, workload.name.size());
  std::string out = fmt::format("{:<{}}  {:<8}  {:<11}  {:>8}  {:>5}  {:>9}\n", "workload", width, "category",
                                "kind", "frames", "tasks", "results");
  uint64_t frames = 0, tasks = 0;
  double model_pixels = 0, render_pixels = 0;
  const size_t configurations = plan.study.configurations.size();
  for (size_t i = 0; i < plan.workloads.size(); ++i) {
    const Workload& workload = plan.workloads[i];
    const WorkloadSize size = size_of_workload(workload, options.render);
    const auto [own_tasks, all, stored] = count_tasks(plan, i, options);
    out += fmt::format("{:<{}}  {:<8}  {:<11}  {:>8}  {:>5}  {:>4}/{:<4}  {}\n", workload.name, width,
                       workload.category, name_of(workload.kind), size.frames > 0 ? std::to_string(size.frames) : "?",
                       own_tasks, stored, all, size.note);
    frames += size.frames;
    tasks += own_tasks;
    model_pixels += static_cast<double>(size.pixels) * static_cast<double>(all - stored) / static_cast<double>(all);
    if (size.to_render) render_pixels += static_cast<double>(size.pixels);
  }
  const double model_s =
      model_pixels * model_ns_per_pixel(plan.study.configurations, options.run.model) / 1e9 / options.jobs;
  out += fmt::format("{}, {}, {}, {}\n", counted(plan.workloads.size(), "workload"),
                     counted(frames, "frame"), counted(tasks, "task"), counted(configurations, "configuration"));
  return out + fmt::format("estimated time: {} to render, {} to model with -j {}\n",
                           duration_text(render_pixels * kRenderNsPerPixel / 1e9), duration_text(model_s),
                           options.jobs);
}

}  // namespace tilepress
