// Frame decoder: no size that the bytes claim is trusted.
#include <zstd.h>

#include <algorithm>
#include <cstring>

#include "frames/little_endian.h"
#include "study/cache/changed_units.h"
#include "study/cache/frame_codec.h"
#include "study/cache/lz4_blocks.h"
#include "study/cache/row_differences.h"

namespace tilepress {
namespace {

constexpr size_t kMapSizeBytes = 4;

Error bad(const char* text) {
  return {ErrorKind::kBadBits, text};
}

}  // namespace

struct FrameDecoder::State {
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  std::vector<std::byte> map, scratch;

  ~State() { ZSTD_freeDCtx(zstd); }

  void make_room(size_t bytes) {
    if (scratch.size() < bytes) scratch.resize(bytes);
  }

  /// Decodes one zstd frame that fills `out` exactly.
  bool unpack_zstd(std::span<const std::byte> from, std::span<std::byte> out,
                   std::span<const std::byte> prefix) {
    ZSTD_DCtx_reset(zstd, ZSTD_reset_session_and_parameters);
    if (!prefix.empty()) ZSTD_DCtx_refPrefix(zstd, prefix.data(), prefix.size());
    return ZSTD_decompressDCtx(zstd, out.data(), out.size(), from.data(), from.size()) == out.size();
  }

  bool decode_zstd(std::span<const std::byte> body, ChangedRuns runs, size_t changed,
                   std::span<std::byte> pixels) {
    if (!unpack_zstd(body, {scratch.data(), changed}, pixels)) return false;
    const std::byte* from = scratch.data();
    for (ChangedRun run; runs.next(run); from += run.bytes())
      std::memcpy(&pixels[run.begin], from, run.bytes());
    return true;
  }

  bool decode_lz4(std::span<const std::byte> body, size_t pitch, ChangedRuns runs, size_t changed,
                  std::span<std::byte> pixels) {
    Lz4Blocks blocks(body);
    ChangedRun run;
    for (size_t done = 0; done < changed;) {
      const auto block = blocks.next({scratch.data(), std::min(kLz4BlockBytes, changed - done)});
      if (block.empty()) return false;
      done += block.size();
      for (size_t used = 0; used < block.size();) {
        if (run.bytes() == 0 && !runs.next(run)) return false;
        const size_t end = run.begin + std::min(run.bytes(), block.size() - used);
        add_row_differences(&block[used], pitch, run.begin, end, pixels.data());
        used += end - run.begin;
        run.begin = end;
      }
    }
    return blocks.at_end();
  }
};

FrameDecoder::FrameDecoder() : state_(std::make_unique<State>()) {}
FrameDecoder::FrameDecoder(FrameDecoder&&) noexcept = default;
FrameDecoder& FrameDecoder::operator=(FrameDecoder&&) noexcept = default;
FrameDecoder::~FrameDecoder() = default;

Result<void> FrameDecoder::decode(const CacheEntry& entry, std::span<const std::byte> stored,
                                  std::span<std::byte> pixels) {
  State& state = *state_;
  if (stored.size() < kMapSizeBytes) return bad("a frame without a map");
  const uint32_t map_bytes = Fields({reinterpret_cast<const char*>(stored.data()), kMapSizeBytes}).take4();
  stored = stored.subspan(kMapSizeBytes);
  if (map_bytes > stored.size() || (map_bytes == 0) != entry.key) return bad("a map of a wrong size");
  state.map.resize(map_bytes == 0 ? 0 : unit_map_bytes(pixels.size()));
  if (map_bytes != 0 && (!state.unpack_zstd(stored.first(map_bytes), state.map, {}) ||
                         has_stray_bits(state.map, pixels.size())))
    return bad("a damaged map");
  const auto body = stored.subspan(map_bytes);
  const size_t changed = changed_bytes(state.map, pixels.size());
  if (changed == 0) return body.empty() ? Result<void>() : bad("bytes after an unchanged frame");
  const ChangedRuns runs(state.map, pixels.size());
  bool good = false;
  if (entry.coding == FrameCoding::kLz4Up) {
    state.make_room(kLz4BlockBytes);
    good = state.decode_lz4(body, entry.frame.pitch_bytes(), runs, changed, pixels);
  } else if (entry.key) {
    good = state.unpack_zstd(body, pixels, {});
  } else {
    state.make_room(changed);
    good = state.decode_zstd(body, runs, changed, pixels);
  }
  if (!good) return bad("damaged pixels");
  return {};
}

}  // namespace tilepress
