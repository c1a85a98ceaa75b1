// Frame encoder: the size of each key frame decides how the frames up to the next one are coded.
#include <zstd.h>

#include <algorithm>
#include <bit>

#include "frames/little_endian.h"
#include "study/cache/changed_units.h"
#include "study/cache/file_bytes.h"
#include "study/cache/frame_codec.h"
#include "study/cache/lz4_blocks.h"
#include "study/cache/row_differences.h"

namespace tilepress {
namespace {

constexpr int kKeyLevel = 3, kDeltaLevel = 1, kMapLevel = 1;
/// LZ4 decodes some five times as fast as zstd. It is taken where the differences of rows make it smaller
/// than zstd all the same.
constexpr double kLz4Share = 0.95;
/// A frame with fewer changes does without the frame before, which takes time to index.
constexpr size_t kFewChanges = 16;

}  // namespace

struct FrameEncoder::State {
  ZSTD_CCtx* zstd = ZSTD_createCCtx();
  std::vector<std::byte> before;   ///< the frame before
  std::vector<std::byte> changed;  ///< bytes of changed units, or their differences
  std::vector<std::byte> packed;
  std::string map, out, lz4;
  uint64_t frames = 0;
  FrameCoding coding = FrameCoding::kZstd;
  size_t lz4_budget = 0;  ///< bytes of a frame that LZ4 codes

  ~State() { ZSTD_freeCCtx(zstd); }

  /// Appends a zstd frame to `out`.
  Result<void> append_zstd(std::span<const std::byte> bytes, int level, std::span<const std::byte> prefix) {
    ZSTD_CCtx_reset(zstd, ZSTD_reset_session_and_parameters);
    ZSTD_CCtx_setParameter(zstd, ZSTD_c_compressionLevel, level);
    if (!prefix.empty()) {
      const int window = std::bit_width(prefix.size() + bytes.size());
      ZSTD_CCtx_setParameter(zstd, ZSTD_c_windowLog, std::clamp(window, 10, 30));
      ZSTD_CCtx_setParameter(zstd, ZSTD_c_enableLongDistanceMatching, 1);
      ZSTD_CCtx_refPrefix(zstd, prefix.data(), prefix.size());
    }
    packed.resize(ZSTD_compressBound(bytes.size()));
    const size_t size = ZSTD_compress2(zstd, packed.data(), packed.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size)) return Error{ErrorKind::kSystem, std::string("zstd: ") + ZSTD_getErrorName(size)};
    out.append(reinterpret_cast<const char*>(packed.data()), size);
    return {};
  }

  /// Sets `lz4` to the blocks of row differences.
  void pack_lz4(std::span<const std::byte> pixels, size_t pitch, std::span<const std::byte> units) {
    gather(pixels, units, [&](const ChangedRun& run, std::byte* to) {
      take_row_differences(pixels.data(), pitch, run.begin, run.end, to);
    });
    pack_lz4_blocks(changed, lz4_budget, lz4);
  }

  template <class Copy>
  void gather(std::span<const std::byte> pixels, std::span<const std::byte> units, const Copy& copy) {
    changed.resize(changed_bytes(units, pixels.size()));
    ChangedRuns runs(units, pixels.size());
    size_t at = 0;
    for (ChangedRun run; runs.next(run); at += run.bytes()) copy(run, changed.data() + at);
  }

  Result<void> encode_key(std::span<const std::byte> pixels, size_t pitch) {
    put_field(out, 0, 4);
    const size_t header = out.size();
    if (const auto done = append_zstd(pixels, kKeyLevel, {}); !done) return done;
    lz4_budget = static_cast<size_t>(kLz4Share * static_cast<double>(out.size() - header));
    pack_lz4(pixels, pitch, {});
    const bool small = lz4.size() < lz4_budget;
    coding = small ? FrameCoding::kLz4Up : FrameCoding::kZstd;
    if (small) out.replace(header, std::string::npos, lz4);
    return {};
  }

  Result<void> encode_delta(std::span<const std::byte> pixels, size_t pitch) {
    const size_t bytes = mark_changed_units(pixels, before, map);
    const auto units = bytes_of(map);
    put_field(out, 0, 4);
    const size_t begin = out.size();
    if (const auto done = append_zstd(units, kMapLevel, {}); !done) return done;
    std::string map_bytes;
    put_field(map_bytes, out.size() - begin, 4);
    out.replace(begin - 4, 4, map_bytes);
    if (bytes == 0) return {};
    if (coding == FrameCoding::kLz4Up) {
      pack_lz4(pixels, pitch, units);
      out += lz4;
      return {};
    }
    gather(pixels, units, [&](const ChangedRun& run, std::byte* to) {
      std::copy(&pixels[run.begin], &pixels[run.begin] + run.bytes(), to);
    });
    const bool few = bytes < pixels.size() / kFewChanges;
    return append_zstd(changed, kDeltaLevel,
                       few ? std::span<const std::byte>() : std::span<const std::byte>(before));
  }
};

FrameEncoder::FrameEncoder() : state_(std::make_unique<State>()) {}
FrameEncoder::~FrameEncoder() = default;

Result<std::span<const std::byte>> FrameEncoder::encode(std::span<const std::byte> pixels,
                                                        CacheEntry& entry) {
  State& state = *state_;
  state.out.clear();
  entry.key = state.frames++ % kKeyFramePeriod == 0;
  const size_t pitch = entry.frame.pitch_bytes();
  const auto done = entry.key ? state.encode_key(pixels, pitch) : state.encode_delta(pixels, pitch);
  if (!done) return done.error();
  entry.coding = state.coding;
  state.before.assign(pixels.begin(), pixels.end());
  return bytes_of(state.out);
}

}  // namespace tilepress
