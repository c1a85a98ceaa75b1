// Micro benchmark: the kernels of a block and the FVC, on every instruction set of this machine.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "dcp/fvc.h"
#include "dcp/collector.h"
#include "pixels/pixel_kernels.h"
#include "ras/ras_kernels.h"
#include "surface_patterns.h"
#include "tilepress/simd.h"

using namespace tilepress;

namespace {

/// Blocks of one pattern, 64 pixels each.
std::vector<uint32_t> blocks_of(uint32_t pattern) {
  return patterns::draw(pattern, kBlockPixels, 1024, PixelFormat::kRgba8, 1).words;
}

void set_rate(benchmark::State& state) {
  state.counters["pixels/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kBlockPixels, benchmark::Counter::kIsRate);
}

void fvc(benchmark::State& state, uint32_t pattern) {
  const std::vector<uint32_t> pixels = blocks_of(pattern);
  Collector collector(FvcConfig{}, traits(PixelFormat::kRgba8));
  size_t at = 0;
  uint32_t block[kBlockPixels];
  for (auto _ : state) {
    if (!pixel_kernels().load_traversal(&pixels[at], kBlockSide, block))
      collector.see({block, kBlockPixels, false, nullptr, pixel_kernels().run_begins(block)});
    at = (at + kBlockPixels) % pixels.size();
  }
  set_rate(state);
}

void plain_fvc(benchmark::State& state, uint32_t pattern) {
  const std::vector<uint32_t> pixels = blocks_of(pattern);
  Fvc collector(FvcConfig{}, traits(PixelFormat::kRgba8));
  size_t at = 0;
  for (auto _ : state) {
    collector.see_all(&pixels[at], kBlockPixels);
    at = (at + kBlockPixels) % pixels.size();
  }
  set_rate(state);
}

void ras(benchmark::State& state, uint32_t pattern, const std::string& target) {
  force_simd_target(target);
  const std::vector<uint32_t> pixels = blocks_of(pattern);
  int16_t samples[kRasSamples];
  size_t at = 0;
  for (auto _ : state) {
    ras_kernels().widen_bytes(&pixels[at], kBlockSide, samples);
    fill_ras_border(samples);
    benchmark::DoNotOptimize(ras_kernels().code_bits(samples));
    at = (at + kBlockPixels) % pixels.size();
  }
  set_rate(state);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::pair<const char*, uint32_t> kPictures[] = {{"solid", patterns::kSolid},
                                                            {"rectangles", patterns::kRectangles},
                                                            {"skewed", patterns::kSkewed},
                                                            {"gradient", patterns::kGradient},
                                                            {"noise", patterns::kNoise}};
  for (const auto& [name, pattern] : kPictures) {
    const std::string suffix = std::string("/") + name;
    benchmark::RegisterBenchmark(("fvc/fast" + suffix).c_str(), fvc, pattern);
    benchmark::RegisterBenchmark(("fvc/plain" + suffix).c_str(), plain_fvc, pattern);
    for (std::string_view target : simd_targets())
      benchmark::RegisterBenchmark(("ras/" + std::string(target) + suffix).c_str(), ras, pattern,
                                   std::string(target));
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
