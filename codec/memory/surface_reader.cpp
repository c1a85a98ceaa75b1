// Surface reader: CSB entry through the cache, then the block's bursts, then the decoder.
#include "tilepress/surface_reader.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "memory/csb_cache.h"
#include "tilepress/scheme.h"

namespace tilepress {

struct SurfaceReader::State {
  const CompressedSurface* surface = nullptr;
  ReadOptions options;
  std::unique_ptr<BlockDecoder> decoder;
  CsbCache cache{0};
  ReadTraffic traffic;
  Block kept;
  uint64_t kept_number = UINT64_MAX;
  uint32_t kept_bits = 0;
  std::vector<MemoryFetch>* fetches = nullptr;

  void note(SurfacePart part, uint64_t offset_bytes, uint64_t bursts) {
    if (fetches != nullptr) fetches->push_back({part, offset_bytes, bursts});
  }
  void fetch_csb(uint64_t number);
  bool load(uint32_t bx, uint32_t by);
};

ReadTraffic& ReadTraffic::operator+=(const ReadTraffic& other) {
  blocks += other.blocks;
  payload_bursts += other.payload_bursts;
  csb_bursts += other.csb_bursts;
  table_bursts += other.table_bursts;
  raw_bursts += other.raw_bursts;
  csb_lookups += other.csb_lookups;
  csb_misses += other.csb_misses;
  return *this;
}

void SurfaceReader::State::fetch_csb(uint64_t number) {
  if (surface->csb_bits == 0) return;
  const uint64_t line_bits = uint64_t{options.csb_line_bursts} * surface->burst_bits;
  const uint64_t first = number * surface->csb_bits / line_bits;
  const uint64_t last = ((number + 1) * surface->csb_bits - 1) / line_bits;
  const uint64_t plane_bursts = (surface->csb_plane_bits() + surface->burst_bits - 1) / surface->burst_bits;
  for (uint64_t line = first; line <= last; ++line) {
    ++traffic.csb_lookups;
    if (cache.touch(line)) continue;
    ++traffic.csb_misses;
    // The plane's last line may be shorter.
    const auto bursts =
        std::min<uint64_t>(options.csb_line_bursts, plane_bursts - line * options.csb_line_bursts);
    traffic.csb_bursts += bursts;
    note(SurfacePart::kCsb, line * line_bits / 8, bursts);
  }
}

bool SurfaceReader::State::load(uint32_t bx, uint32_t by) {
  const uint64_t number = uint64_t{by} * surface->blocks_x() + bx;
  if (number == kept_number) return true;
  kept_number = UINT64_MAX;
  fetch_csb(number);
  const uint64_t csb_end = (number + 1) * surface->csb_bits;
  BitReader csb(surface->csb, csb_end);
  csb.skip(csb_end - surface->csb_bits);
  // Slots lie too far apart for the hardware prefetcher.
  if (number + 2 < surface->blocks())
    __builtin_prefetch(&surface->payload[(number + 2) * surface->slot_bytes()]);
  BitReader payload(
      std::span(surface->payload).subspan(number * surface->slot_bytes(), surface->slot_bytes()));
  if (!decoder->decode_at(bx, by, csb, payload, kept)) return false;
  kept_number = number;
  kept_bits = static_cast<uint32_t>(payload.position());
  ++traffic.blocks;
  const uint64_t bursts = (kept_bits + surface->burst_bits - 1) / surface->burst_bits;
  traffic.payload_bursts += bursts;
  note(SurfacePart::kPayload, number * surface->slot_bytes(), bursts);
  traffic.raw_bursts += surface->raw_block_bursts();
  return true;
}

SurfaceReader::SurfaceReader() : state_(std::make_unique<State>()) {}
SurfaceReader::~SurfaceReader() = default;
SurfaceReader::SurfaceReader(SurfaceReader&&) noexcept = default;
SurfaceReader& SurfaceReader::operator=(SurfaceReader&&) noexcept = default;

Result<void> SurfaceReader::open(const CompressedSurface& surface, const ReadOptions& options) {
  State& state = *state_;
  std::vector<MemoryFetch>* const fetches = state.fetches;
  state = State{};
  state.fetches = fetches;
  if (const auto checked = surface.consistent(); !checked) return checked;
  const SchemeInfo* info = find_scheme(surface.scheme.name);
  if (info == nullptr) return Error{ErrorKind::kBadBits, "unknown scheme '" + surface.scheme.name + "'"};
  if (!info->supports(surface.format))
    return Error{ErrorKind::kBadBits, "scheme " + surface.scheme.name + " does not support " +
                                          std::string(traits(surface.format).name) + " surfaces"};
  if (info->needs_frame_before)
    return Error{ErrorKind::kBadBits,
                 "a frame of scheme " + surface.scheme.name + " cannot be read without the frame before"};
  ModelOptions model;
  model.tile_side = surface.tile_side;
  model.burst_bits = surface.burst_bits;
  auto decoder = info->make_decoder(surface.scheme, traits(surface.format), model);
  BitReader tables(surface.tables, surface.table_bits);
  if (!decoder->begin_frame(tables, surface.table_bits, surface.csb_bits))
    return Error{ErrorKind::kBadBits, "tables that scheme " + surface.scheme.text + " does not write"};
  state.surface = &surface;
  state.options = options;
  state.options.csb_line_bursts = std::max(1u, options.csb_line_bursts);
  state.decoder = std::move(decoder);
  state.cache = CsbCache(options.csb_lines);
  state.traffic.table_bursts = (surface.table_bits + surface.burst_bits - 1) / surface.burst_bits;
  if (surface.table_bits > 0) state.note(SurfacePart::kTables, 0, state.traffic.table_bursts);
  return {};
}

void SurfaceReader::note_fetches(std::vector<MemoryFetch>* fetches) {
  state_->fetches = fetches;
}

bool SurfaceReader::read_block(uint32_t bx, uint32_t by, Block& out) {
  const CompressedSurface* surface = state_->surface;
  if (surface == nullptr || bx >= surface->blocks_x() || by >= surface->blocks_y()) return false;
  if (!state_->load(bx, by)) return false;
  out = state_->kept;
  return true;
}

bool SurfaceReader::read_pixel(uint32_t x, uint32_t y, uint32_t& out) {
  const CompressedSurface* surface = state_->surface;
  if (surface == nullptr || x >= surface->width || y >= surface->height) return false;
  if (!state_->load(x / kBlockSide, y / kBlockSide)) return false;
  out = state_->kept.pixels[y % kBlockSide * kBlockSide + x % kBlockSide];
  return true;
}

bool SurfaceReader::read_rect(const PixelRect& rect, std::vector<uint32_t>& out) {
  const CompressedSurface* surface = state_->surface;
  if (surface == nullptr || rect.width < 1 || rect.height < 1 ||
      uint64_t{rect.x} + rect.width > surface->width || uint64_t{rect.y} + rect.height > surface->height)
    return false;
  out.resize(size_t{rect.width} * rect.height);
  const uint32_t right = rect.x + rect.width, bottom = rect.y + rect.height;
  for (uint32_t by = rect.y / kBlockSide; by * kBlockSide < bottom; ++by)
    for (uint32_t bx = rect.x / kBlockSide; bx * kBlockSide < right; ++bx) {
      if (!state_->load(bx, by)) return false;
      const uint32_t x_begin = std::max(rect.x, bx * kBlockSide);
      const uint32_t x_end = std::min(right, (bx + 1) * kBlockSide);
      const uint32_t y_end = std::min(bottom, (by + 1) * kBlockSide);
      for (uint32_t y = std::max(rect.y, by * kBlockSide); y < y_end; ++y)
        std::memcpy(&out[size_t{y - rect.y} * rect.width + (x_begin - rect.x)],
                    &state_->kept.pixels[y % kBlockSide * kBlockSide + x_begin % kBlockSide],
                    (x_end - x_begin) * sizeof(uint32_t));
    }
  return true;
}

const ReadTraffic& SurfaceReader::traffic() const {
  return state_->traffic;
}
void SurfaceReader::reset_traffic() {
  state_->traffic = ReadTraffic{};
}
uint32_t SurfaceReader::last_block_bits() const {
  return state_->kept_bits;
}

}  // namespace tilepress
