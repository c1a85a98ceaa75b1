// Surface engine: one traversal of a frame serves every scheme; a thing that two schemes need is computed
// once.
#include "tilepress/surface_engine.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>

#include "block_check.h"
#include "collectors.h"
#include "memory/surface_store.h"
#include "ras/ras_memo.h"
#include "row_prefetch.h"
#include "pixels/pixel_kernels.h"
#include "solid_blocks.h"
#include "tilepress/scheme.h"
#include "tilepress/tiler.h"

namespace tilepress {
namespace {

struct Lane {
  std::unique_ptr<BlockEncoder> encoder;
  std::unique_ptr<BlockDecoder> decoder;  ///< only with verify
  SchemeNeeds needs;
  Collector* collector = nullptr;
  const uint16_t* ccd_indices = nullptr;  ///< of the block being visited, see BlockContext
  const uint8_t* ccd_widths = nullptr;
  uint32_t csb_bits = 0;
  SurfaceStore store;
  std::array<SchemeStatistics, SolidBlocks::kPlaces> solids;  ///< what a block of each colour kept adds
};

/// Adds the time of a step to that of the frame.
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
  std::vector<SchemeSpec> specs;
  ModelOptions options;
  Collectors collectors;  ///< with frame_metrics the first is the default, theirs
  std::vector<Lane> lanes;
  PixelPlane now;
  bool referred = false;    ///< now is the frame where it lies, and no copy
  bool prefetches = false;  ///< rows of the next tiles are asked for
  RowPrefetch prefetch;
  uint64_t changed = 0;  ///< pixels, since the frame before
  RasMemo ras_memo;
  BlockCheck check;
  uint64_t ordinal = 0;
  bool has_before = false;  ///< now held a frame before this one
  bool opened = false;      ///< lanes and collectors are there
  bool needs_ras = false, needs_ras_ycocg = false, needs_raster = false, needs_raster_to_encode = false;
  bool needs_whole_frame = false;
  bool compares_frames = false;  ///< with the one before, so that a copy of it is needed
  bool can_repeat = true;        ///< blocks of one colour count like the first of that colour
  SolidBlocks solids;
  bool last_solid = false;                ///< the block visited last was of one colour,
  uint32_t last_place = 0;                ///< which is kept there
  std::span<CompressedSurface> surfaces;  ///< where this frame is stored; empty if nowhere
  BlockBits* block_bits = nullptr;
  uint32_t burst_round = 0, burst_shift = 0;  ///< burst_bits is a power of two
  SurfaceView frame;                          ///< at hand, from begin() to the last advance()
  FrameStatistics* out = nullptr;
  uint32_t next_row = 0;  ///< of blocks
  void open(const FormatTraits& format);
  void begin_frame();
  void take_rows(uint32_t begin, uint32_t end);
  void prefetch_tiles(uint32_t begin);
  void prefetch_beside(uint32_t bx, uint32_t bx_end, uint32_t by);
  void advance();
  void check_block(Lane& lane, const BlockContext& context, uint32_t payload_bits, SchemeStatistics& added);
  void visit_block(uint32_t bx, uint32_t by, const FormatTraits& format);
  uint32_t repeat_last(uint32_t bx, uint32_t bx_end, uint32_t by);
  void repeat_solid(uint32_t place, uint32_t bx, uint32_t count, uint32_t by);
  void settle_repeats(uint32_t place);
  uint32_t pixels_inside(uint32_t bx, uint32_t blocks, uint32_t by) const;
  void collect(const BlockContext& block);
  uint32_t ras_bits(const BlockContext& block, const uint32_t* top_left, const FormatTraits& format,
                    bool ycocg) {
    if (block.uniform) return ras_uniform_bits(format, ycocg);
    return ras_memo.bits(size_t{block.by} * now.blocks_x() + block.bx, top_left, now.stride(), format, ycocg);
  }
  void end_frame();
};

void SurfaceEngine::State::open(const FormatTraits& format) {
  opened = true;
  burst_round = options.burst_bits - 1;
  burst_shift = static_cast<uint32_t>(std::countr_zero(options.burst_bits));
  if (options.frame_metrics) collectors.of(FvcConfig{}, format);
  for (const SchemeSpec& spec : specs) {
    const SchemeInfo* info = find_scheme(spec.name);
    assert(info != nullptr);
    Lane lane;
    lane.encoder = info->make_encoder(spec, format, options);
    if (options.verify) lane.decoder = info->make_decoder(spec, format, options);
    lane.needs = lane.encoder->needs();
    if (lane.needs.ccd) {
      lane.collector = &collectors.of(spec.fvc, format);
      lane.collector->wanted = true;
    }
    needs_ras |= lane.needs.ras;
    needs_ras_ycocg |= lane.needs.ras_ycocg;
    needs_raster |= lane.needs.raster || options.verify;
    needs_raster_to_encode |= lane.needs.raster_to_encode;
    needs_whole_frame |= lane.needs.whole_frame;
    can_repeat &= !lane.needs.place && !options.verify;
    lanes.push_back(std::move(lane));
  }
  compares_frames = options.frame_metrics || needs_ras || needs_ras_ycocg;
  collectors.open(options.frame_metrics);
}

void SurfaceEngine::State::begin_frame() {
  if (!opened) open(traits(frame.format));
  const uint64_t tile_bytes = uint64_t{options.tile_side} * frame.width * sizeof(uint32_t);
  const bool few_bytes = tile_bytes <= RowPrefetch::kMostBytes;
  referred = !compares_frames && few_bytes && now.refer_to(frame);
  if (!referred) now.reshape(frame);
  prefetches = few_bytes && (referred || !needs_whole_frame);
  out->width = frame.width;
  out->height = frame.height;
  out->format = frame.format;
  out->warmup = ordinal == 0;
  changed = 0;
  ras_memo.begin_frame(now.blocks(), has_before, needs_ras, needs_ras_ycocg);
  if (needs_whole_frame) take_rows(0, now.blocks_y());
  collectors.begin_frame(ordinal, size_t{now.width()} * now.height());
  solids.clear();
  last_solid = false;
  out->schemes.assign(lanes.size(), SchemeStatistics{});
  if (block_bits != nullptr) {
    block_bits->blocks_x = now.blocks_x();
    block_bits->blocks_y = now.blocks_y();
    block_bits->raw_bits = kBlockPixels * traits(now.format()).pixel_bits;
    block_bits->schemes.resize(lanes.size());
    for (auto& plane : block_bits->schemes) plane.resize(now.blocks());
  }
  for (size_t i = 0; i < lanes.size(); ++i) {
    Lane& lane = lanes[i];
    const Ccd* ccd = lane.collector != nullptr ? lane.collector->ccd() : nullptr;
    lane.ccd_indices = ccd != nullptr ? lane.collector->indices() : nullptr;
    lane.ccd_widths = ccd != nullptr ? lane.collector->widths() : nullptr;
    const FrameContext context{.plane = now, .ordinal = ordinal, .ccd = ccd};
    lane.encoder->begin_frame(context);
    if (!surfaces.empty()) lane.store.begin_frame(specs[i], options, context, *lane.encoder, surfaces[i]);
    lane.csb_bits = lane.encoder->csb_bits();
    SchemeStatistics& scheme = out->schemes[i];
    scheme.burst_bits = options.burst_bits;
    scheme.palette_bits = lane.encoder->palette_bits();
    if (lane.decoder && !check.begin_frame(*lane.encoder, *lane.decoder))
      scheme.mismatched_blocks = now.blocks();
  }
}

/// Takes a copy of rows `begin` to `end` of blocks, if one is needed.
void SurfaceEngine::State::take_rows(uint32_t begin, uint32_t end) {
  if (referred) return;
  changed += now.assign_rows(frame, begin * kBlockSide, end * kBlockSide, ras_memo.changed_blocks());
}

/// While the row of tiles before row `begin` of blocks is visited, those of the next one are asked for.
void SurfaceEngine::State::prefetch_tiles(uint32_t begin) {
  const uint32_t y = std::min(begin * kBlockSide, frame.height);
  prefetch.aim(frame, y, std::min(y + options.tile_side, frame.height));
}

/// What is asked for while blocks `bx` to `bx_end` of row `by` are visited.
void SurfaceEngine::State::prefetch_beside(uint32_t bx, uint32_t bx_end, uint32_t by) {
  constexpr uint32_t kBlockLines = kBlockPixels * sizeof(uint32_t) / RowPrefetch::kLineBytes;
  prefetch.step((bx_end - bx) * kBlockLines);
  if (referred) RowPrefetch::bring_nearer(now, bx_end, std::min(2 * bx_end - bx, now.blocks_x()), by);
}

/// Pixels of blocks side by side that lie inside the surface: padding never enters the FVC.
uint32_t SurfaceEngine::State::pixels_inside(uint32_t bx, uint32_t blocks, uint32_t by) const {
  return std::min(blocks * kBlockSide, now.width() - bx * kBlockSide) *
         std::min(kBlockSide, now.height() - by * kBlockSide);
}

void SurfaceEngine::State::collect(const BlockContext& block) {
  uint32_t count = pixels_inside(block.bx, 1, block.by);
  if (block.uniform) return collectors.see_solid(block.pixels[0], count);
  if (count == kBlockPixels) return collectors.see(block.pixels, count);
  const uint32_t width = now.width() - block.bx * kBlockSide, height = now.height() - block.by * kBlockSide;
  uint32_t inside[kBlockPixels];
  count = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i)
    if (kTraversal[i] % 8 < width && kTraversal[i] / 8 < height) inside[count++] = block.pixels[i];
  collectors.see(inside, count);
}

/// Blocks of one colour, as the last was, come in rows. Returns how many from `bx` on are like that one.
uint32_t SurfaceEngine::State::repeat_last(uint32_t bx, uint32_t bx_end, uint32_t by) {
  const uint32_t* top_left = now.row(by * kBlockSide) + bx * kBlockSide;
  const uint32_t color = solids.color(last_place);
  const uint32_t count = pixel_kernels().solid_blocks(top_left, now.stride(), color, bx_end - bx);
  if (count != 0) repeat_solid(last_place, bx, count, by);
  return count;
}

/// `count` blocks side by side of the colour kept at `place`.
void SurfaceEngine::State::repeat_solid(uint32_t place, uint32_t bx, uint32_t count, uint32_t by) {
  solids.repeat(place, count);
  collectors.see_solid(solids.color(place), pixels_inside(bx, count, by));
  if (!surfaces.empty())
    for (Lane& lane : lanes) lane.store.put_again(place, bx, bx + count, by);
  if (block_bits != nullptr)
    for (size_t i = 0; i < lanes.size(); ++i)
      std::fill_n(block_bits->schemes[i].begin() + (ptrdiff_t{by} * block_bits->blocks_x + bx), count,
                  static_cast<uint16_t>(lanes[i].solids[place].payload_bits));
}

void SurfaceEngine::State::settle_repeats(uint32_t place) {
  const uint64_t repeats = solids.take_repeats(place);
  if (repeats == 0) return;
  for (size_t i = 0; i < lanes.size(); ++i) out->schemes[i].add(lanes[i].solids[place], repeats);
}

// Not inline: it is rare, and large.
[[gnu::noinline]] void SurfaceEngine::State::check_block(Lane& lane, const BlockContext& context,
                                                         uint32_t payload_bits, SchemeStatistics& added) {
  ++added.checked_blocks;
  added.mismatched_blocks += !check.round_trip(*lane.encoder, *lane.decoder, context, payload_bits);
}

void SurfaceEngine::State::visit_block(uint32_t bx, uint32_t by, const FormatTraits& format) {
  const uint32_t* top_left = now.row(by * kBlockSide) + bx * kBlockSide;
  alignas(64) uint32_t pixels[kBlockPixels];
  Block block;
  BlockContext context{.block = block, .bx = bx, .by = by, .pixels = pixels};
  context.uniform = collectors.load(top_left, now.stride(), pixels);
  last_solid = context.uniform;
  if (context.uniform) {
    last_place = SolidBlocks::place_of(pixels[0]);
    if (can_repeat && solids.holds(last_place, pixels[0])) return repeat_solid(last_place, bx, 1, by);
    settle_repeats(last_place);
    solids.keep(last_place, pixels[0]);
    collectors.look_up_solid(pixels);
  }
  if (needs_raster || (needs_raster_to_encode && !surfaces.empty())) now.load_block(bx, by, block);
  if (needs_ras) context.ras_bits = ras_bits(context, top_left, format, false);
  if (needs_ras_ycocg) context.ras_ycocg_bits = ras_bits(context, top_left, format, true);
  for (size_t i = 0; i < lanes.size(); ++i) {
    Lane& lane = lanes[i];
    context.ccd_indices = lane.ccd_indices;
    context.ccd_widths = lane.ccd_widths;
    const uint32_t payload_bits =
        surfaces.empty() ? lane.encoder->measure(context) : lane.store.put(*lane.encoder, context);
    SchemeStatistics& added = context.uniform ? lane.solids[last_place] : out->schemes[i];
    if (context.uniform) {
      added = {};
      if (!surfaces.empty()) lane.store.keep(last_place);
    }
    added.payload_bits += payload_bits;
    added.bursts += (payload_bits + burst_round) >> burst_shift;
    lane.encoder->account(context, payload_bits, added);
    if (lane.decoder) check_block(lane, context, payload_bits, added);
    if (context.uniform) out->schemes[i].add(added, 1);
    if (block_bits != nullptr)
      block_bits->schemes[i][size_t{by} * block_bits->blocks_x + bx] = static_cast<uint16_t>(payload_bits);
  }
  collect(context);
}

void SurfaceEngine::State::advance() {
  if (next_row == 0) begin_frame();
  const FormatTraits& format = traits(frame.format);
  const uint32_t begin = next_row;
  next_row = std::min(begin + options.tile_side / kBlockSide, now.blocks_y());
  if (!needs_whole_frame) take_rows(begin, next_row);  // they are at hand then
  if (prefetches) {
    if (referred && begin == 0) prefetch_tiles(0), prefetch.step(UINT32_MAX);
    prefetch_tiles(next_row);
  }
  for_each_row_in_tiles(now.blocks_x(), begin, next_row, options.tile_side,
                        [&](uint32_t bx, uint32_t bx_end, uint32_t by) {
                          if (prefetches) prefetch_beside(bx, bx_end, by);
                          while (bx < bx_end) {
                            if (last_solid && can_repeat) bx += repeat_last(bx, bx_end, by);
                            if (bx < bx_end) visit_block(bx++, by, format);
                          }
                        });
  if (next_row == now.blocks_y()) end_frame();
}

void SurfaceEngine::State::end_frame() {
  for (uint32_t place = 0; place < SolidBlocks::kPlaces; ++place) settle_repeats(place);
  collectors.end_frame();
  const uint64_t blocks = now.blocks();
  for (size_t i = 0; i < lanes.size(); ++i) {
    SchemeStatistics& scheme = out->schemes[i];
    scheme.blocks = blocks;
    scheme.raw_bits = blocks * kBlockPixels * traits(now.format()).pixel_bits;
    scheme.csb_bits = blocks * lanes[i].csb_bits;
  }
  out->metrics = collectors.metrics(now, has_before ? std::optional(changed) : std::nullopt);
  collectors.build_ccds();
  has_before = true;
  ++ordinal;
}

SurfaceEngine::SurfaceEngine(const std::vector<SchemeSpec>& schemes, const ModelOptions& options)
    : state_(std::make_unique<State>()) {
  state_->specs = schemes;
  state_->options = options;
}
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
  if (!state_->opened) state_->open(traits(format));
  std::vector<uint64_t> frames;
  if (ordinal == 0) return frames;
  frames.push_back(ordinal - 1);
  for (const auto& collector : state_->collectors)
    frames.push_back((ordinal - 1) / collector->fvc().config().period * collector->fvc().config().period);
  for (const Lane& lane : state_->lanes)
    if (lane.needs.first_frame) frames.push_back(0);
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
  assert(!state.has_before || state.now.has_shape_of(frame));
  out.encode_ns = 0;
  state.frame = frame;
  state.out = &out;
  state.surfaces = surfaces;
  state.next_row = 0;
}

bool SurfaceEngine::advance() {
  const StepTime time(*state_->out);
  state_->advance();
  return state_->next_row < state_->now.blocks_y();
}

}  // namespace tilepress
