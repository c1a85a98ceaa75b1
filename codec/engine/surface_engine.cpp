// Surface engine: the loop over a frame's blocks. One traversal serves every scheme; what several schemes
// need is computed once.
//
//   pixel source → block ─┬→ look-up in the CCD and other shared analyses → lanes: measure, store, check,
//   account
//                         └→ FVC → CCD of the next frame
#include "tilepress/surface_engine.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>

#include "engine/block_runs.h"
#include "engine/collectors.h"
#include "engine/lanes.h"
#include "engine/pixel_source.h"
#include "memory/bus_toggles.h"
#include "tilepress/tiler.h"

namespace tilepress {
namespace {

/// Adds the time of a step to the time of the frame.
class StepTime {
 public:
  explicit StepTime(FrameStatistics& frame) : frame_(frame) {}
  ~StepTime() {
    const auto time = std::chrono::steady_clock::now() - begin_;
    frame_.encode_ns +=
        static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(time).count());
  }

 private:
  FrameStatistics& frame_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

struct SurfaceEngine::State {
  const std::vector<SchemeSpec> specs;
  const ModelOptions options;
  std::optional<SharedAnalyses> analyses;   ///< none before the first frame
  std::vector<BlockAnalysis*> per_block{};  ///< those that see each block; the collectors load it
  Collectors collectors{};
  PixelSource source{};
  BlockRuns runs{};
  Lanes lanes{};
  uint64_t ordinal = 0;
  BlockBits* block_bits = nullptr;

  // The frame at hand, from begin() to the last advance().
  SurfaceView frame{};
  FrameStatistics* out = nullptr;
  std::span<CompressedSurface> surfaces{};
  std::vector<CompressedSurface> kept_surfaces{};  ///< for the toggles, where the caller keeps none
  uint32_t next_row = 0;  ///< of blocks

  void open(PixelFormat format);
  void begin_frame();
  void take_tiles();
  void visit_block(uint32_t bx, uint32_t by);
  void collect(const BlockContext& block);
  void repeat_block(uint32_t bx, uint32_t count, uint32_t by);
  void settle_repeats(uint32_t place) { lanes.settle(place, runs.take_repeats(place)); }
  void count_toggles();
  void end_frame();
};

void SurfaceEngine::State::open(PixelFormat format) {
  analyses.emplace(traits(format));
  analyses->provide<CcdSource>(collectors);
  collectors.open(traits(format), options.frame_metrics);
  lanes.open(specs, format, options, *analyses);
  bool notes_changes = false;
  analyses->for_each([&](BlockAnalysis& analysis) {
    if (&analysis == &collectors) return;
    per_block.push_back(&analysis);
    notes_changes |= analysis.wants_changes();
  });
  source.open({.tile_side = options.tile_side,
               .whole_frame = lanes.needs().whole_frame,
               .compares = options.frame_metrics || notes_changes,
               .notes_changes = notes_changes});
  runs.open(!lanes.needs().place && !options.verify);
}

void SurfaceEngine::State::begin_frame() {
  if (!analyses) open(frame.format);
  source.begin_frame(frame);
  out->width = frame.width;
  out->height = frame.height;
  out->format = frame.format;
  out->warmup = ordinal == 0;
  runs.begin_frame();
  collectors.begin(ordinal, size_t{frame.width} * frame.height);
  const FrameContext context{source.plane(), ordinal, source.changed_blocks()};
  for (BlockAnalysis* analysis : per_block) analysis->begin_frame(context);
  if (options.toggle_bits != 0 && surfaces.empty()) {
    kept_surfaces.resize(specs.size());
    surfaces = kept_surfaces;
  }
  lanes.begin_frame(context, surfaces, block_bits, out->schemes);
}

/// Takes a row of render tiles.
void SurfaceEngine::State::take_tiles() {
  if (next_row == 0) begin_frame();
  const PixelPlane& plane = source.plane();
  const uint32_t begin = next_row;
  next_row = std::min(begin + options.tile_side / kBlockSide, plane.blocks_y());
  source.take_rows(begin, next_row);
  for_each_row_in_tiles(plane.blocks_x(), begin, next_row, options.tile_side,
                        [&](uint32_t bx, uint32_t bx_end, uint32_t by) {
                          source.prefetch_beside(bx, bx_end, by);
                          while (bx < bx_end) {
                            const uint32_t repeats = runs.count_on(plane, bx, bx_end, by);
                            if (repeats != 0) repeat_block(bx, repeats, by);
                            bx += repeats;
                            if (bx < bx_end) visit_block(bx++, by);
                          }
                        });
  if (next_row == plane.blocks_y()) end_frame();
}

void SurfaceEngine::State::visit_block(uint32_t bx, uint32_t by) {
  alignas(64) uint32_t pixels[kBlockPixels];
  BlockContext block{.bx = bx, .by = by, .pixels = pixels};
  block.uniform = collectors.load(source.block(bx, by), source.plane().stride(), pixels);
  if (!block.uniform) {
    runs.leave();
  } else if (runs.enter(pixels[0])) {
    return repeat_block(bx, 1, by);
  } else {
    settle_repeats(runs.place());
    runs.hold(pixels[0]);
    collectors.look_up_solid(pixels[0]);
  }
  for (BlockAnalysis* analysis : per_block) analysis->see_block(block);
  lanes.take(block, runs.place());
  collect(block);
}

/// Feeds the FVCs with the block's pixels inside the surface: padding never enters an FVC.
void SurfaceEngine::State::collect(const BlockContext& block) {
  uint32_t count = source.pixels_inside(block.bx, 1, block.by);
  if (block.uniform) return collectors.see_solid(block.pixels[0], count);
  if (count == kBlockPixels) return collectors.see(block.pixels, count);
  const uint32_t width = frame.width - block.bx * kBlockSide, height = frame.height - block.by * kBlockSide;
  uint32_t inside[kBlockPixels] = {};
  count = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i)
    if (kTraversal[i] % 8 < width && kTraversal[i] / 8 < height) inside[count++] = block.pixels[i];
  collectors.see(inside, count);
}

/// Takes `count` blocks side by side of the colour at runs.place().
void SurfaceEngine::State::repeat_block(uint32_t bx, uint32_t count, uint32_t by) {
  runs.repeat(count);
  collectors.see_solid(runs.color(), source.pixels_inside(bx, count, by));
  lanes.take_repeats(runs.place(), bx, count, by);
}

void SurfaceEngine::State::count_toggles() {
  MemoryBus raw(options.toggle_bits);
  send_raw(source.plane(), options.tile_side, options.burst_bits, raw);
  for (size_t i = 0; i < specs.size(); ++i) {
    SchemeStatistics& scheme = out->schemes[i];
    if (scheme.skipped) continue;
    MemoryBus bus(options.toggle_bits);
    send_surface(surfaces[i], bus);
    scheme.toggles = {bus.toggles(), bus.toggles_with_inversion(), raw.toggles(),
                      raw.toggles_with_inversion()};
  }
}

void SurfaceEngine::State::end_frame() {
  for (uint32_t place = 0; place < BlockRuns::kPlaces; ++place) settle_repeats(place);
  collectors.end_frame();
  out->metrics = collectors.metrics(source.plane(), source.changed());
  lanes.end_frame();
  if (options.toggle_bits != 0) count_toggles();
  collectors.build_dictionaries();
  source.end_frame();
  ++ordinal;
}

SurfaceEngine::SurfaceEngine(const std::vector<SchemeSpec>& schemes, const ModelOptions& options)
    : state_(new State{.specs = schemes, .options = options, .analyses = std::nullopt}) {}
SurfaceEngine::~SurfaceEngine() = default;
SurfaceEngine::SurfaceEngine(SurfaceEngine&&) noexcept = default;
SurfaceEngine& SurfaceEngine::operator=(SurfaceEngine&&) noexcept = default;

void SurfaceEngine::note_block_bits(BlockBits* bits) {
  state_->block_bits = bits;
}

uint64_t SurfaceEngine::frames() const {
  return state_->ordinal;
}

std::vector<uint64_t> SurfaceEngine::history(uint64_t ordinal, PixelFormat format) {
  if (!state_->analyses) state_->open(format);
  std::vector<uint64_t> frames;
  const uint64_t depth = std::min<uint64_t>(ordinal, state_->lanes.needs().second_frame_before ? 2 : 1);
  if (depth == 0) return frames;
  for (uint64_t before = ordinal - depth; before < ordinal; ++before) {
    frames.push_back(before);
    state_->collectors.for_each_period([&](uint32_t period) { frames.push_back(before / period * period); });
  }
  if (state_->lanes.needs().first_frame) frames.push_back(0);
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

void SurfaceEngine::seek(uint64_t ordinal) {
  state_->ordinal = ordinal;
}

void SurfaceEngine::process(const SurfaceView& frame, FrameStatistics& out) {
  process(frame, out, {});
}

void SurfaceEngine::process(const SurfaceView& frame, FrameStatistics& out,
                            std::span<CompressedSurface> surfaces) {
  begin(frame, out, surfaces);
  while (advance()) {
  }
}

void SurfaceEngine::begin(const SurfaceView& frame, FrameStatistics& out,
                          std::span<CompressedSurface> surfaces) {
  State& state = *state_;
  assert(surfaces.empty() || surfaces.size() == state.specs.size());
  assert(!state.source.has_before() || state.source.plane().has_shape_of(frame));
  out.encode_ns = 0;
  state.frame = frame;
  state.out = &out;
  state.surfaces = surfaces;
  state.next_row = 0;
}

bool SurfaceEngine::advance() {
  const StepTime time(*state_->out);
  state_->take_tiles();
  return state_->next_row < state_->source.plane().blocks_y();
}

}  // namespace tilepress
