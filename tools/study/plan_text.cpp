// Plan text: frames are counted, times are estimated from a small picture.
#include "plan_text.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "counted.h"
#include "frames/image_frames.h"
#include "study/cache/frame_cache.h"
#include "study/study_task.h"
#include "tilepress/surface_engine.h"
#include "tilepress/trace_summary.h"

namespace tilepress {
namespace {

/// What llvmpipe takes for a pixel of a simple scene, readback and compression included, on one core.
constexpr double kRenderNsPerPixel = 20;

struct WorkloadSize {
  uint64_t frames = 0;  ///< 0 = not known
  uint64_t pixels = 0;  ///< of all frames
  bool to_render = false;
  std::string note;
};

WorkloadSize size_of_cache(const std::string& path) {
  FrameCacheReader reader;
  if (const auto opened = reader.open(path); !opened) return {.note = opened.error().text};
  WorkloadSize size{.frames = reader.frame_count(), .note = "in the cache"};
  for (uint64_t i = 0; i < size.frames; ++i) size.pixels += uint64_t{reader.header(i).width} * reader.header(i).height;
  return size;
}

WorkloadSize size_of_trace(const Workload& workload, const RenderOptions& render) {
  const auto rendered = find_rendered(workload.trace, render);
  if (!rendered) return {.note = rendered.error().text};
  if (*rendered) return size_of_cache(**rendered);
  const auto trace = summarize_trace(workload.paths[0]);
  if (!trace) return {.note = trace.error().text};
  WorkloadSize size{.frames = trace->frames, .to_render = true, .note = "to render"};
  for (const TraceSurface& surface : trace->surfaces)
    size.pixels += surface.frames * std::max(uint64_t{1}, uint64_t{surface.width} * surface.height);
  return size;
}

WorkloadSize size_of_images(const Workload& workload) {
  ImageFrames images;
  if (const auto opened = images.open(workload.paths, std::nullopt); !opened) return {.note = opened.error().text};
  WorkloadSize size{.frames = images.count().value_or(0), .note = images.streamed() ? "a stream of frames" : ""};
  size.pixels = size.frames * images.size().pixels();
  return size;
}

WorkloadSize size_of(const Workload& workload, const StudyOptions& options) {
  switch (workload.kind) {
    case WorkloadKind::kTrace: return size_of_trace(workload, options.render);
    case WorkloadKind::kFrameCache: return size_of_cache(workload.paths[0]);
    case WorkloadKind::kImages: return size_of_images(workload);
    case WorkloadKind::kRun: return {.note = "its rows are the results"};
  }
  return {};
}

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

/// Results of a workload that the folder has.
size_t stored_results(const StudyPlan& plan, size_t workload, const StudyOptions& options) {
  const auto record = load_workload_record(options.folder, plan.workloads[workload].name);
  if (!record || !record->has_frames()) return 0;
  size_t stored = 0;
  for (const StudyTask& task : plan.tasks)
    if (task.workload == workload)
      stored += task.configurations.size() - missing_configurations(plan, task, *record, options).size();
  return stored;
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
    const WorkloadSize size = size_of(workload, options);
    const size_t stored = stored_results(plan, i, options);
    const auto own_tasks = static_cast<uint64_t>(std::ranges::count(plan.tasks, i, &StudyTask::workload));
    out += fmt::format("{:<{}}  {:<8}  {:<11}  {:>8}  {:>5}  {:>4}/{:<4}  {}\n", workload.name, width,
                       workload.category, name_of(workload.kind), size.frames > 0 ? std::to_string(size.frames) : "?",
                       own_tasks, stored, configurations, size.note);
    frames += size.frames;
    tasks += own_tasks;
    model_pixels += static_cast<double>(size.pixels) * static_cast<double>(configurations - std::min(stored, configurations)) /
                    static_cast<double>(configurations);
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
