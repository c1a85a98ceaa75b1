// Workload size: a function per kind of workload.
#include "workload_size.h"

#include <algorithm>

#include "frames/image_frames.h"
#include "tilepress/trace_summary.h"

namespace tilepress {
namespace {

WorkloadSize size_of_cache(const std::string& path) {
  FrameCacheReader reader;
  if (const auto opened = reader.open(path); !opened) return {.note = opened.error().text};
  return {.frames = reader.frame_count(), .pixels = pixels_of(reader), .note = "in the cache"};
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

}  // namespace

WorkloadSize size_of_workload(const Workload& workload, const RenderOptions& render) {
  switch (workload.kind) {
    case WorkloadKind::kTrace: return size_of_trace(workload, render);
    case WorkloadKind::kFrameCache: return size_of_cache(workload.paths[0]);
    case WorkloadKind::kImages: return size_of_images(workload);
    case WorkloadKind::kRun: return {.note = "its rows are the results"};
  }
  return {};
}

uint64_t pixels_of(const FrameCacheReader& cache) {
  uint64_t pixels = 0;
  for (uint64_t i = 0; i < cache.frame_count(); ++i) pixels += uint64_t{cache.header(i).width} * cache.header(i).height;
  return pixels;
}

}  // namespace tilepress
