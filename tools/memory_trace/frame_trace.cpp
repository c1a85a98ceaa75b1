// Frame trace: places surfaces, times frames, and passes their accesses to the timeline.
#include "memory_trace/frame_trace.h"

#include <algorithm>
#include <set>

#include "memory_trace/frame_accesses.h"
#include "streams/ending_signals.h"

namespace tilepress {
namespace {

/// When a frame is written and shown, in picoseconds.
struct FrameTimes {
  uint64_t begin = 0, present = 0, end = 0;
};

/// The times at which the frames are presented.
std::vector<uint64_t> present_times(const TracedFrames& frames, const MemoryTraceOptions& options,
                                    uint64_t period) {
  std::vector<uint64_t> times;
  const bool recorded = frames.has_times() && !options.refresh_hz;
  uint64_t refresh = 0;
  std::set<uint32_t> shown;  // surfaces that presented in this refresh
  for (const LoggedFrame& frame : frames.frames()) {
    if (!shown.insert(frame.surface).second || refresh == 0) {
      ++refresh;
      shown = {frame.surface};
    }
    // Frames that leave the worker in order were presented in order, whatever the clocks of threads say.
    const uint64_t least = times.empty() ? 0 : times.back();
    times.push_back(recorded ? std::max(least, frame.time_ns * 1000) : refresh * period);
  }
  return times;
}

std::vector<FrameTimes> frame_times(const TracedFrames& frames, const MemoryTraceOptions& options,
                                    uint64_t period) {
  const std::vector<uint64_t> presents = present_times(frames, options, period);
  std::vector<FrameTimes> times(presents.size());
  std::map<uint32_t, size_t> before;  // of each surface
  for (size_t i = 0; i < times.size(); ++i) {
    const uint64_t present = presents[i];
    times[i] = {present - std::min(present, period), present, present + period};
    const auto [known, is_first] = before.try_emplace(frames.frames()[i].surface, i);
    if (!is_first) {
      const uint64_t gap = present - presents[known->second];
      times[i].begin = present - std::min(gap, period);
      times[known->second].end = presents[known->second] + std::min(gap, period);
      known->second = i;
    }
  }
  return times;
}

/// Places each surface for the largest tables that it has.
Result<void> place_surfaces(TracedFrames& frames, MemoryMap& map) {
  std::map<uint32_t, uint64_t> most_table_bits;
  for (const LoggedFrame& frame : frames.frames())
    most_table_bits[frame.surface] = std::max(most_table_bits[frame.surface], frame.table_bits);
  CompressedSurface shape;
  for (size_t i = 0; i < frames.frames().size(); ++i) {
    const uint32_t surface = frames.frames()[i].surface;
    if (map.has(surface)) continue;
    if (const auto read = frames.read(i, shape); !read) return read;
    map.add(surface, shape, most_table_bits[surface]);
  }
  return {};
}

}  // namespace

Result<std::string> write_frame_trace(const std::string& path, const MemoryTraceOptions& options,
                                      TracedFrames& frames, ProgressMode progress) {
  if (options.content && !frames.has_data())
    return Error{ErrorKind::kUnsupported, "--trace-data: the run logged sizes alone; capture it with --trace-data"};
  const uint64_t period = frame_period_ps(options.refresh_hz.value_or(60));
  MemoryMap map(options.base);
  if (const auto placed = place_surfaces(frames, map); !placed) return placed.error();
  const std::vector<FrameTimes> times = frame_times(frames, options, period);
  MemoryTrace trace;
  if (const auto opened = trace.open(path, options, frames.model().burst_bits); !opened) return opened.error();
  ProgressLine line(progress, "memory trace");
  for (size_t i = 0; i < times.size(); ++i) {
    auto stored = std::make_shared<CompressedSurface>();
    if (const auto read = frames.read(i, *stored); !read) return read.error();
    const LoggedFrame& frame = frames.frames()[i];
    AccessStream stream{.frame = frame.frame, .surface = frame.surface, .place = map.place(frame.surface), .accesses = {}, .stored = nullptr};
    if (options.content) stream.stored = stored;
    // No later frame begins before that: none begins more than a period before its present.
    const uint64_t settled = times[i].present - std::min(times[i].present, period);
    if (const auto done = trace.timeline().advance_to(settled); !done) return done.error();
    stream.write = true;
    stream.begin_ps = times[i].begin;
    stream.end_ps = times[i].present;
    stream.accesses = frame_writes(*stored, options.form());
    trace.timeline().add(stream);
    stream.write = false;
    stream.begin_ps = times[i].present;
    stream.end_ps = times[i].end;
    stream.accesses = display_reads(*stored, options.form());
    trace.timeline().add(std::move(stream));
    ++trace.totals().frames;
    line.show(i + 1, times.size());
    if (noted_signal() != 0) return Error{ErrorKind::kSystem, signal_text(noted_signal())};
  }
  if (const auto done = trace.finish(); !done) return done.error();
  return trace.summary();
}

}  // namespace tilepress
