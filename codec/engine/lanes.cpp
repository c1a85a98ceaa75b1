// Lanes: the block path of the schemes.
#include "engine/lanes.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace tilepress {

void Lanes::open(std::span<const SchemeSpec> specs, PixelFormat format, const ModelOptions& options,
                 SharedAnalyses& analyses) {
  options_ = options;
  burst_shift_ = static_cast<uint32_t>(std::countr_zero(options.burst_bits));
  for (const SchemeSpec& spec : specs) {
    const SchemeInfo* info = find_scheme(spec.name);
    assert(info != nullptr);
    const size_t index = skipped_.size();
    skipped_.push_back(!info->supports(format));
    if (skipped_.back()) continue;
    Lane lane{.spec = spec, .index = index, .encoder = info->make_encoder(spec, analyses.format(), options)};
    if (options.verify) lane.decoder = info->make_decoder(spec, analyses.format(), options);
    lane.encoder->subscribe(analyses);
    const SchemeNeeds needs = lane.encoder->needs();
    needs_.first_frame |= needs.first_frame;
    needs_.whole_frame |= needs.whole_frame;
    needs_.place |= needs.place;
    needs_.second_frame_before |= needs.second_frame_before;
    lanes_.push_back(std::move(lane));
  }
}

void Lanes::begin_frame(const FrameContext& frame, std::span<CompressedSurface> surfaces,
                        BlockBits* block_bits, std::vector<SchemeStatistics>& out) {
  out_ = &out;
  block_bits_ = block_bits;
  stores_ = !surfaces.empty();
  blocks_ = frame.plane.blocks();
  raw_block_bits_ = kBlockPixels * traits(frame.plane.format()).pixel_bits;
  out.assign(skipped_.size(), SchemeStatistics{});
  for (size_t i = 0; i < skipped_.size(); ++i) out[i].skipped = skipped_[i];
  if (block_bits != nullptr) {
    block_bits->blocks_x = frame.plane.blocks_x();
    block_bits->blocks_y = frame.plane.blocks_y();
    block_bits->raw_bits = raw_block_bits_;
    block_bits->schemes.resize(skipped_.size());
    for (size_t i = 0; i < skipped_.size(); ++i) block_bits->schemes[i].resize(skipped_[i] ? 0 : blocks_);
  }
  for (Lane& lane : lanes_)
    begin_lane(lane, frame, stores_ ? &surfaces[lane.index] : nullptr, out[lane.index]);
}

void Lanes::begin_lane(Lane& lane, const FrameContext& frame, CompressedSurface* surface,
                       SchemeStatistics& out) {
  lane.encoder->begin_frame(frame);
  if (surface != nullptr) lane.store.begin_frame(lane.spec, options_, frame, *lane.encoder, *surface);
  lane.csb_bits = lane.encoder->csb_bits();
  out.burst_bits = options_.burst_bits;
  out.palette_bits = lane.encoder->palette_bits();
  if (lane.decoder && !check_.begin_frame(*lane.encoder, *lane.decoder)) out.mismatched_blocks = blocks_;
}

// Not inline: rare and large.
[[gnu::noinline]] void Lanes::check_block(Lane& lane, const BlockContext& block, uint32_t payload_bits,
                                          SchemeStatistics& added) {
  ++added.checked_blocks;
  added.mismatched_blocks += !check_.round_trip(*lane.encoder, *lane.decoder, block, payload_bits);
}

void Lanes::take(const BlockContext& block, uint32_t place) {
  for (Lane& lane : lanes_) {
    const uint32_t payload_bits =
        stores_ ? lane.store.put(*lane.encoder, block) : lane.encoder->measure(block);
    SchemeStatistics& added = block.uniform ? lane.solids[place] : (*out_)[lane.index];
    if (block.uniform) {
      added = {};
      if (stores_) lane.store.keep(place);
    }
    added.payload_bits += payload_bits;
    added.bursts += (payload_bits + options_.burst_bits - 1) >> burst_shift_;
    lane.encoder->account(block, payload_bits, added);
    if (lane.decoder) check_block(lane, block, payload_bits, added);
    if (block.uniform) (*out_)[lane.index].add(added, 1);
    if (block_bits_ != nullptr)
      block_bits_->schemes[lane.index][size_t{block.by} * block_bits_->blocks_x + block.bx] =
          static_cast<uint16_t>(payload_bits);
  }
}

void Lanes::take_repeats(uint32_t place, uint32_t bx, uint32_t count, uint32_t by) {
  if (stores_)
    for (Lane& lane : lanes_) lane.store.put_again(place, bx, bx + count, by);
  if (block_bits_ != nullptr)
    for (const Lane& lane : lanes_)
      std::fill_n(block_bits_->schemes[lane.index].begin() + (ptrdiff_t{by} * block_bits_->blocks_x + bx),
                  count, static_cast<uint16_t>(lane.solids[place].payload_bits));
}

void Lanes::settle(uint32_t place, uint64_t repeats) {
  if (repeats == 0) return;
  for (const Lane& lane : lanes_) (*out_)[lane.index].add(lane.solids[place], repeats);
}

void Lanes::end_frame() {
  for (const Lane& lane : lanes_) {
    SchemeStatistics& scheme = (*out_)[lane.index];
    scheme.blocks = blocks_;
    scheme.raw_bits = blocks_ * raw_block_bits_;
    scheme.csb_bits = blocks_ * lane.csb_bits;
    scheme.fvc = lane.encoder->fvc_figures();
  }
}

}  // namespace tilepress
