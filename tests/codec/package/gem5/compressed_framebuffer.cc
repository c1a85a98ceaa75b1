// Compressed framebuffer: a SurfaceEngine that stores each frame, and a SurfaceReader that reads it. C++20.
#include "compressed_framebuffer.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "tilepress/scheme.h"
#include "tilepress/surface_engine.h"
#include "tilepress/surface_reader.h"
#include "tilepress/tiler.h"

namespace simulator {

using namespace tilepress;

struct CompressedFramebuffer::State {
  FramebufferSettings settings;
  std::string error{};
  std::vector<uint8_t> drawn{};
  std::optional<SurfaceEngine> engine{};
  FrameStatistics statistics{};
  CompressedSurface surface{};  ///< the frame that ended last, as DRAM holds it
  uint64_t csb_base = 0, tables_base = 0;

  struct RowBlock {
    bool valid = false;
    Block block;
  };
  SurfaceReader reader{};
  std::vector<MemoryFetch> fetches{};
  bool open = false;
  uint32_t row = 0;  ///< of blocks, that `blocks` holds
  std::vector<RowBlock> blocks{};

  void lay_out();
  void write_block(uint64_t number, const Write& write) const;
  void write_part(uint64_t base, std::vector<uint8_t> bytes, const Write& write) const;
  const Block* fetched(uint32_t bx, uint32_t by, const Fetch& fetch);
  void pass_fetches(const Fetch& fetch);
};

CompressedFramebuffer::CompressedFramebuffer(const FramebufferSettings& settings)
    : state_(new State{settings}) {
  const auto scheme = parse_scheme(settings.scheme);
  if (!scheme) {
    state_->error = scheme.error().text;
    return;
  }
  if (find_scheme(scheme->name)->needs_frame_before) {
    state_->error = scheme->name + ": its frames cannot be read without the frame before";
    return;
  }
  ModelOptions model;
  model.tile_side = settings.tile;
  model.burst_bits = settings.burst_bytes * 8;
  model.frame_metrics = false;
  state_->engine.emplace(std::vector{*scheme}, model);
  state_->drawn.resize(bytes());
}

CompressedFramebuffer::~CompressedFramebuffer() = default;

const std::string& CompressedFramebuffer::error() const {
  return state_->error;
}

uint64_t CompressedFramebuffer::bytes() const {
  return uint64_t{state_->settings.width} * state_->settings.height * 4;
}

uint64_t CompressedFramebuffer::dram_bytes() const {
  const auto blocks = [](uint32_t pixels) { return uint64_t{pixels + kBlockSide - 1} / kBlockSide; };
  constexpr uint64_t kMostCsbBytes = 16, kMostTableBytes = 8192;  // of a block, of a frame
  const uint64_t slot_bytes = std::max(256u, state_->settings.burst_bytes);
  return blocks(state_->settings.width) * blocks(state_->settings.height) * (slot_bytes + kMostCsbBytes) +
         kMostTableBytes;
}

uint8_t* CompressedFramebuffer::drawn() {
  return state_->drawn.data();
}

uint64_t CompressedFramebuffer::raw_bursts() const {
  const SchemeStatistics& frame = state_->statistics.schemes.front();
  return frame.raw_bits / frame.burst_bits;
}

void CompressedFramebuffer::end_frame(const Write& write) {
  end_frame(drawn(), ptrdiff_t{state_->settings.width} * 4, write);
}

void CompressedFramebuffer::end_frame(const uint8_t* top_row, ptrdiff_t pitch_bytes, const Write& write) {
  State& state = *state_;
  const SurfaceView frame{.top_row = reinterpret_cast<const std::byte*>(top_row),
                          .pitch_bytes = pitch_bytes,
                          .width = state.settings.width,
                          .height = state.settings.height};
  state.engine->process(frame, state.statistics, std::span(&state.surface, 1));
  state.lay_out();
  const uint32_t blocks_x = state.surface.blocks_x(), blocks_y = state.surface.blocks_y();
  const uint32_t step = state.settings.tile / kBlockSide;
  const auto visit = [&](uint32_t bx, uint32_t bx_end, uint32_t by) {
    for (; bx < bx_end; ++bx) state.write_block(uint64_t{by} * blocks_x + bx, write);
  };
  for (uint32_t row = 0; row < blocks_y; row += step)
    for_each_row_in_tiles(blocks_x, row, std::min(row + step, blocks_y), state.settings.tile, visit);
  state.write_part(state.csb_base, state.surface.csb, write);
  state.write_part(state.tables_base, state.surface.tables, write);
  state.blocks.assign(blocks_x, {});
  state.open = false;
}

void CompressedFramebuffer::State::lay_out() {
  const uint64_t step = std::max(64u, settings.burst_bytes);
  const auto align = [step](uint64_t at) { return (at + step - 1) / step * step; };
  csb_base = align(settings.dram_base + surface.blocks() * surface.slot_bytes());
  tables_base = align(csb_base + surface.csb.size());
}

void CompressedFramebuffer::State::write_block(uint64_t number, const Write& write) const {
  const uint64_t slot = number * surface.slot_bytes();
  for (uint64_t at = 0; at * 8 < surface.block_bits[number]; at += settings.burst_bytes)
    write(settings.dram_base + slot + at, &surface.payload[slot + at]);
}

/// Writes whole bursts, the last one filled up with zeros.
void CompressedFramebuffer::State::write_part(uint64_t base, std::vector<uint8_t> bytes,
                                              const Write& write) const {
  const size_t burst = settings.burst_bytes;
  bytes.resize((bytes.size() + burst - 1) / burst * burst);
  for (size_t at = 0; at < bytes.size(); at += burst) write(base + at, &bytes[at]);
}

bool CompressedFramebuffer::read(uint64_t offset, uint8_t* out, size_t size, const Fetch& fetch) {
  State& state = *state_;
  if (state.surface.width == 0) return false;
  for (size_t i = 0; i < size; i += 4) {
    const uint64_t pixel = (offset + i) / 4;
    const auto x = static_cast<uint32_t>(pixel % state.surface.width);
    const auto y = static_cast<uint32_t>(pixel / state.surface.width);
    const Block* block = state.fetched(x / kBlockSide, y / kBlockSide, fetch);
    if (block == nullptr) return false;
    std::memcpy(out + i, &block->pixels[y % kBlockSide * kBlockSide + x % kBlockSide], 4);
  }
  return true;
}

const Block* CompressedFramebuffer::State::fetched(uint32_t bx, uint32_t by, const Fetch& fetch) {
  if (!open) {
    reader.note_fetches(&fetches);
    if (!reader.open(surface, ReadOptions{})) return nullptr;
    open = true;
  }
  if (row != by) blocks.assign(blocks.size(), {});
  row = by;
  RowBlock& kept = blocks[bx];
  if (!kept.valid) kept.valid = reader.read_block(bx, by, kept.block);
  pass_fetches(fetch);
  return kept.valid ? &kept.block : nullptr;
}

/// Passes on what the reader fetched: tables, lines of CSB, payload.
void CompressedFramebuffer::State::pass_fetches(const Fetch& fetch) {
  for (const MemoryFetch& run : fetches) {
    const uint64_t base = run.part == SurfacePart::kPayload ? settings.dram_base
                          : run.part == SurfacePart::kCsb   ? csb_base
                                                            : tables_base;
    for (uint64_t i = 0; i < run.bursts; ++i) fetch(base + run.offset_bytes + i * settings.burst_bytes);
  }
  fetches.clear();
}

}  // namespace simulator
