// Composed trace: the fetches of the readers as accesses.
#include "frames/composed_trace.h"

#include <algorithm>

namespace tilepress {

Result<void> ComposedTrace::open(const MemoryTraceOptions& options,
                                 const std::vector<std::unique_ptr<PackedFile>>& files, double refresh_hz) {
  options_ = options;
  period_ps_ = frame_period_ps(refresh_hz);
  map_ = MemoryMap(options.base);
  struct Shape {
    SurfaceKey key;
    CompressedSurface first;
    uint64_t most_table_bits = 0;
  };
  std::vector<Shape> shapes;
  CompressedSurface surface;
  for (size_t file = 0; file < files.size(); ++file)
    for (uint32_t number = 0; number < files[file]->reader.count(); ++number) {
      if (const auto read = files[file]->reader.read(number, surface); !read)
        return about(files[file]->path, read.error());
      if (const auto known = check_traced_scheme(surface.scheme.name); !known)
        return about(files[file]->path, known.error());
      if (!shapes.empty() && shapes.front().first.burst_bits != surface.burst_bits)
        return Error{ErrorKind::kUnsupported,
                     files[file]->path + ": bursts of " + std::to_string(surface.burst_bits) +
                         " bits, and the first file has " + std::to_string(shapes.front().first.burst_bits) +
                         "; a memory trace has one size"};
      const SurfaceKey key = key_of(file, surface);
      auto known = std::ranges::find(shapes, key, &Shape::key);
      if (known == shapes.end()) known = shapes.insert(known, {key, surface, 0});
      known->most_table_bits = std::max(known->most_table_bits, surface.table_bits);
    }
  for (const Shape& shape : shapes) {
    const auto number = static_cast<uint32_t>(numbers_.size());
    numbers_[shape.key] = number;
    map_.add(number, shape.first, shape.most_table_bits);
  }
  return trace_.open(options.path, options, shapes.front().first.burst_bits);
}

std::vector<MemoryFetch> ComposedTrace::accesses_of(const CompressedSurface& surface,
                                                    const std::vector<MemoryFetch>& fetches) const {
  std::vector<MemoryFetch> accesses;
  for (MemoryFetch fetch : fetches) {
    if (options_.raw) fetch.bursts = fetch.part == SurfacePart::kPayload ? surface.raw_block_bursts() : 0;
    if (fetch.bursts > 0) accesses.push_back(fetch);
  }
  return accesses;
}

Result<void> ComposedTrace::add(uint64_t frame, const std::vector<Layer>& layers,
                                const std::vector<LayerTraffic>& reads) {
  const uint64_t begin = trace_.totals().frames++ * period_ps_;
  if (const auto done = trace_.timeline().advance_to(begin); !done) return done;
  for (size_t i = 0; i < layers.size(); ++i) {
    const CompressedSurface& surface = layers[i].surface;
    const uint32_t number = numbers_.at(key_of(i, surface));
    trace_.timeline().add(
        {.frame = frame,
         .surface = number,
         .begin_ps = begin,
         .end_ps = begin + period_ps_,
         .place = map_.place(number),
         .accesses = accesses_of(surface, reads[i].fetches),
         .stored = options_.content ? std::make_shared<CompressedSurface>(surface) : nullptr});
  }
  return {};
}

Result<std::string> ComposedTrace::finish() {
  if (const auto done = trace_.finish(); !done) return done.error();
  return trace_.summary();
}

}  // namespace tilepress
