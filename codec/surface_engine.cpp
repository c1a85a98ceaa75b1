// Surface engine: one traversal of a frame serves every scheme; a thing that two schemes need is computed
// once.
#include "tilepress/surface_engine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <deque>
#include <utility>

#include "block_check.h"
#include "dcp/ccd.h"
#include "dcp/fvc.h"
#include "memory/surface_store.h"
#include "ras/ras_stream.h"
#include "statistics/frame_metrics.h"
#include "tilepress/scheme.h"
#include "tilepress/tiler.h"

namespace tilepress {
namespace {

/// An FVC configuration in use: what it collects, and the dictionary in force.
struct Collector {
  Collector(const FvcConfig& config, const FormatTraits& format) : fvc(config, format) {}
  Fvc fvc;
  Ccd ccd;
  CcdLookup lookup;
  bool has_ccd = false;
  bool wanted = false;      ///< a scheme looks colours up in its CCD
  bool collecting = false;  ///< in this frame
  std::array<uint16_t, kBlockPixels> indices;
};

struct Lane {
  std::unique_ptr<BlockEncoder> encoder;
  std::unique_ptr<BlockDecoder> decoder;  ///< only with verify
  SchemeNeeds needs;
  Collector* collector = nullptr;
  uint32_t csb_bits = 0;
  SurfaceStore store;
};

}  // namespace

struct SurfaceEngine::State {
  std::vector<SchemeSpec> specs;
  ModelOptions options;
  std::deque<Collector> collectors;  ///< the first is the default configuration, of the frame metrics
  std::vector<Lane> lanes;
  PixelPlane now, before;
  FrameMeter meter;
  BlockCheck check;
  uint64_t ordinal = 0;
  bool needs_ras = false, needs_ras_ycocg = false;
  std::span<CompressedSurface> surfaces;  ///< where this frame is stored; empty if nowhere

  void open(const FormatTraits& format);
  Collector& collector_for(const FvcConfig& config, const FormatTraits& format);
  void begin_frame(FrameStatistics& out);
  void visit_block(uint32_t bx, uint32_t by, const FormatTraits& format, FrameStatistics& out);
  void collect(const Block& block, uint32_t bx, uint32_t by);
  void end_frame(FrameStatistics& out);
};

Collector& SurfaceEngine::State::collector_for(const FvcConfig& config, const FormatTraits& format) {
  for (Collector& collector : collectors)
    if (collector.fvc.config() == config) return collector;
  return collectors.emplace_back(config, format);
}

void SurfaceEngine::State::open(const FormatTraits& format) {
  collector_for(FvcConfig{}, format);
  for (const SchemeSpec& spec : specs) {
    const SchemeInfo* info = find_scheme(spec.name);
    assert(info != nullptr);
    Lane lane;
    lane.encoder = info->make_encoder(spec, format, options);
    if (options.verify) lane.decoder = info->make_decoder(spec, format, options);
    lane.needs = lane.encoder->needs();
    if (lane.needs.ccd) {
      lane.collector = &collector_for(spec.fvc, format);
      lane.collector->wanted = true;
    }
    needs_ras |= lane.needs.ras;
    needs_ras_ycocg |= lane.needs.ras_ycocg;
    lanes.push_back(std::move(lane));
  }
}

void SurfaceEngine::State::begin_frame(FrameStatistics& out) {
  for (Collector& collector : collectors) {
    collector.collecting = ordinal % collector.fvc.config().period == 0;
    if (collector.collecting) collector.fvc.reset();
  }
  out.schemes.assign(lanes.size(), SchemeStatistics{});
  for (size_t i = 0; i < lanes.size(); ++i) {
    Lane& lane = lanes[i];
    const Ccd* ccd = lane.collector != nullptr && lane.collector->has_ccd ? &lane.collector->ccd : nullptr;
    const FrameContext frame{.plane = now, .ordinal = ordinal, .ccd = ccd};
    lane.encoder->begin_frame(frame);
    if (!surfaces.empty()) lane.store.begin_frame(specs[i], options, frame, *lane.encoder, surfaces[i]);
    lane.csb_bits = lane.encoder->csb_bits();
    SchemeStatistics& scheme = out.schemes[i];
    scheme.burst_bits = options.burst_bits;
    scheme.palette_bits = lane.encoder->palette_bits();
    if (lane.decoder && !check.begin_frame(*lane.encoder, *lane.decoder))
      scheme.mismatched_blocks = now.blocks();
  }
}

void SurfaceEngine::State::collect(const Block& block, uint32_t bx, uint32_t by) {
  const uint32_t width = std::min(kBlockSide, now.width() - bx * kBlockSide);
  const uint32_t height = std::min(kBlockSide, now.height() - by * kBlockSide);
  const bool whole = width == kBlockSide && height == kBlockSide;
  for (Collector& collector : collectors) {
    if (!collector.collecting) continue;
    for (const uint8_t position : kTraversal)
      if (whole || (position % 8 < width && position / 8 < height)) collector.fvc.see(block.pixels[position]);
  }
}

void SurfaceEngine::State::visit_block(uint32_t bx, uint32_t by, const FormatTraits& format,
                                       FrameStatistics& out) {
  Block block;
  now.load_block(bx, by, block);
  for (Collector& collector : collectors)
    if (collector.wanted && collector.has_ccd) collector.lookup.find_block(block, collector.indices);
  BlockContext context{.block = block, .bx = bx, .by = by};
  if (needs_ras) context.ras_bits = ras_stream_bits(block, format, false);
  if (needs_ras_ycocg) context.ras_ycocg_bits = ras_stream_bits(block, format, true);
  for (size_t i = 0; i < lanes.size(); ++i) {
    Lane& lane = lanes[i];
    SchemeStatistics& scheme = out.schemes[i];
    context.ccd_indices =
        lane.collector != nullptr && lane.collector->has_ccd ? lane.collector->indices.data() : nullptr;
    const uint32_t payload_bits = lane.encoder->measure(context);
    scheme.payload_bits += payload_bits;
    scheme.bursts += (payload_bits + options.burst_bits - 1) / options.burst_bits;
    lane.encoder->account(context, payload_bits, scheme);
    if (!surfaces.empty()) lane.store.put(*lane.encoder, context);
    if (lane.decoder) {
      ++scheme.checked_blocks;
      scheme.mismatched_blocks += !check.round_trip(*lane.encoder, *lane.decoder, context, payload_bits);
    }
  }
  collect(block, bx, by);
}

void SurfaceEngine::State::end_frame(FrameStatistics& out) {
  const uint64_t blocks = now.blocks();
  for (size_t i = 0; i < lanes.size(); ++i) {
    SchemeStatistics& scheme = out.schemes[i];
    scheme.blocks = blocks;
    scheme.raw_bits = blocks * kBlockPixels * traits(now.format()).pixel_bits;
    scheme.csb_bits = blocks * lanes[i].csb_bits;
  }
  out.metrics = meter.measure(now, ordinal == 0 ? nullptr : &before, collectors.front().fvc);
  for (Collector& collector : collectors) {
    if (!collector.wanted || !collector.collecting) continue;
    collector.ccd.build(collector.fvc);
    collector.lookup.build(collector.ccd);
    collector.has_ccd = true;
  }
  std::swap(now, before);
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

uint64_t SurfaceEngine::frames() const {
  return state_->ordinal;
}

void SurfaceEngine::process(const SurfaceView& frame, FrameStatistics& out) {
  process(frame, out, {});
}

void SurfaceEngine::process(const SurfaceView& frame, FrameStatistics& out,
                            std::span<CompressedSurface> surfaces) {
  assert(surfaces.empty() || surfaces.size() == state_->specs.size());
  state_->surfaces = surfaces;
  const auto begin = std::chrono::steady_clock::now();
  State& state = *state_;
  const FormatTraits& format = traits(frame.format);
  state.now.assign(frame);
  if (state.ordinal == 0)
    state.open(format);
  else
    assert(state.now.same_shape(state.before));
  out.width = frame.width;
  out.height = frame.height;
  out.format = frame.format;
  out.warmup = state.ordinal == 0;
  state.begin_frame(out);
  for_each_block(state.now.blocks_x(), state.now.blocks_y(), state.options.tile_side,
                 [&](uint32_t bx, uint32_t by) { state.visit_block(bx, by, format, out); });
  state.end_frame(out);
  const auto end = std::chrono::steady_clock::now();
  out.encode_ns =
      static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count());
}

}  // namespace tilepress
