// Bench rounds: each operation is a closure over its own state, run once per round.
#include "frames/bench_rounds.h"

#include <lz4.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <memory>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

struct Operation {
  std::string scheme, name;
  std::function<void(size_t frame)> run;
  std::vector<double> seconds, cycles;  ///< by round
};

uint64_t cycle_counter() {
#if defined(__x86_64__)
  return __rdtsc();
#else
  return 0;
#endif
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What the closures share.
struct Bench {
  const BenchFrames& frames;
  const ModelOptions model;
  std::vector<Operation> operations;

  SurfaceView view(size_t frame) const {
    return {frames.pixels[frame].data(),
            static_cast<ptrdiff_t>(frames.width) * 4,
            frames.width,
            frames.height,
            frames.format,
            ByteOrder::kRgba};
  }
  void add(std::string scheme, std::string name, std::function<void(size_t)> run) {
    operations.push_back({std::move(scheme), std::move(name), std::move(run), {}, {}});
  }
  void add_yardsticks();
  void add_statistics(const std::string& label, const std::vector<SchemeSpec>& schemes, bool metrics);
  void add_encode(const SchemeSpec& scheme);
  void add_decode(const SchemeSpec& scheme);
  void round(bool counted);
};

void Bench::add_yardsticks() {
  const size_t bytes = size_t{frames.width} * frames.height * 4;
  auto copy = std::make_shared<std::vector<std::byte>>(bytes);
  add("memcpy", "copy",
      [this, bytes, copy](size_t frame) { std::memcpy(copy->data(), frames.pixels[frame].data(), bytes); });
  auto packed =
      std::make_shared<std::vector<char>>(static_cast<size_t>(LZ4_compressBound(static_cast<int>(bytes))));
  add("lz4", "compress", [this, bytes, packed](size_t frame) {
    LZ4_compress_default(reinterpret_cast<const char*>(frames.pixels[frame].data()), packed->data(),
                         static_cast<int>(bytes), static_cast<int>(packed->size()));
  });
}

void Bench::add_statistics(const std::string& label, const std::vector<SchemeSpec>& schemes, bool metrics) {
  ModelOptions options = model;
  options.frame_metrics = metrics;
  auto engine = std::make_shared<SurfaceEngine>(schemes, options);
  auto out = std::make_shared<FrameStatistics>();
  add(label, "statistics", [this, engine, out](size_t frame) { engine->process(view(frame), *out); });
}

void Bench::add_encode(const SchemeSpec& scheme) {
  ModelOptions options = model;
  options.frame_metrics = false;
  auto engine = std::make_shared<SurfaceEngine>(std::vector{scheme}, options);
  auto out = std::make_shared<FrameStatistics>();
  auto surfaces = std::make_shared<std::vector<CompressedSurface>>(1);
  add(scheme.text, "encode",
      [this, engine, out, surfaces](size_t frame) { engine->process(view(frame), *out, *surfaces); });
}

void Bench::add_decode(const SchemeSpec& scheme) {
  ModelOptions options = model;
  options.frame_metrics = false;
  SurfaceEngine engine({scheme}, options);
  FrameStatistics out;
  auto surfaces = std::make_shared<std::vector<CompressedSurface>>(frames.pixels.size());
  // The second pass begins with the CCD that a later round would find.
  for (size_t pass = 0; pass < 2; ++pass)
    for (size_t i = 0; i < frames.pixels.size(); ++i)
      engine.process(view(i), out, std::span(&(*surfaces)[i], 1));
  auto decoder = std::shared_ptr<BlockDecoder>(
      find_scheme(scheme.name)->make_decoder(scheme, traits(frames.format), options));
  add(scheme.text, "decode", [surfaces, decoder](size_t frame) {
    const CompressedSurface& surface = (*surfaces)[frame];
    BitReader tables(surface.tables, surface.table_bits);
    decoder->begin_frame(tables, surface.table_bits, surface.csb_bits);
    BitReader csb(surface.csb, surface.csb_plane_bits());
    Block block;
    const std::span<const uint8_t> payload = surface.payload;
    const uint32_t slot = surface.slot_bytes();
    for (uint64_t i = 0; i < surface.blocks(); ++i) {
      // Slots lie too far apart for the hardware prefetcher.
      if (i + 4 < surface.blocks()) __builtin_prefetch(&payload[(i + 4) * slot]);
      BitReader reader(payload.subspan(i * slot, slot));
      decoder->decode(csb, reader, block);
    }
  });
}

void Bench::round(bool counted) {
  for (Operation& operation : operations) {
    const auto begin = std::chrono::steady_clock::now();
    const uint64_t begin_cycles = cycle_counter();
    for (size_t frame = 0; frame < frames.pixels.size(); ++frame) operation.run(frame);
    const uint64_t cycles = cycle_counter() - begin_cycles;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    if (!counted) continue;
    operation.seconds.push_back(elapsed.count());
    operation.cycles.push_back(static_cast<double>(cycles));
  }
}

}  // namespace

std::vector<BenchRow> bench_set(const BenchFrames& frames, const std::vector<SchemeSpec>& schemes,
                                const ModelOptions& model, uint32_t rounds,
                                const std::function<void(uint32_t)>& round_done) {
  Bench bench{.frames = frames, .model = model, .operations = {}};
  bench.add_yardsticks();
  for (const SchemeSpec& scheme : schemes) {
    bench.add_statistics(scheme.text, {scheme}, false);
    bench.add_encode(scheme);
    bench.add_decode(scheme);
  }
  bench.add_statistics("all", schemes, false);
  bench.add_statistics("metrics", {}, true);
  bench.round(false);
  for (uint32_t i = 0; i < rounds; ++i) {
    bench.round(true);
    round_done(i + 1);
  }

  const double pixels =
      static_cast<double>(frames.width) * frames.height * static_cast<double>(frames.pixels.size());
  const auto ratio_to = [&](const Operation& operation, const Operation& yardstick) {
    std::vector<double> ratios;
    for (size_t i = 0; i < operation.seconds.size(); ++i)
      ratios.push_back(yardstick.seconds[i] / operation.seconds[i]);
    return median(ratios);
  };
  std::vector<BenchRow> rows;
  for (const Operation& operation : bench.operations)
    rows.push_back({operation.scheme, operation.name, pixels / median(operation.seconds) / 1e6,
                    ratio_to(operation, bench.operations[0]), ratio_to(operation, bench.operations[1]),
                    median(operation.cycles) / pixels});
  return rows;
}

}  // namespace tilepress
