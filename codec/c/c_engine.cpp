// C engine: the functions tp_engine_* of tilepress.h.
#include <memory>
#include <ranges>
#include <string>
#include <vector>

#include "c/c_calls.h"
#include "tilepress/bit_io.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"
#include "tilepress/surface_engine.h"

using namespace tilepress;

struct tp_engine {
  tp_engine(std::vector<SchemeSpec> schemes, const COptions& options, SurfaceView surface)
      : specs(std::move(schemes)), shape(surface), engine(specs, options.model), totals(specs.size()) {
    engine.note_block_bits(&block_bits);
    if (options.keeps_blocks) surfaces.resize(specs.size());
    for (SchemeStatistics& total : totals) total.burst_bits = options.model.burst_bits;
  }
  const std::vector<SchemeSpec> specs;
  const SurfaceView shape;  ///< without pixels
  SurfaceEngine engine;
  BlockBits block_bits;
  std::vector<CompressedSurface> surfaces;  ///< empty unless blocks are kept
  FrameStatistics frame;
  std::vector<SchemeStatistics> totals;  ///< without the first frame
  bool has_frame = false;
};

namespace {

/// Parses specifications with spaces between.
Result<std::vector<SchemeSpec>> parse_list(std::string_view text) {
  std::vector<SchemeSpec> specs;
  for (const auto& word : std::views::split(text, ' ')) {
    const std::string_view part(word.begin(), word.end());
    if (part.empty()) continue;
    auto parsed = parse_schemes(part);
    if (!parsed) return parsed.error();
    for (SchemeSpec& spec : *parsed) specs.push_back(std::move(spec));
    if (specs.size() > kMostSchemes)
      return Error{ErrorKind::kBadValue, "more than " + std::to_string(kMostSchemes) + " configurations"};
  }
  if (specs.empty()) return Error{ErrorKind::kBadValue, "schemes names no scheme"};
  return specs;
}

tp_status open_engine(uint32_t width, uint32_t height, uint32_t format, const char* schemes,
                      const tp_options* options, std::unique_ptr<tp_engine>& out) {
  if (schemes == nullptr) return c_failure(TP_BAD_ARGUMENT, "schemes is NULL");
  if (width < 1 || width > kMaxSurfaceSide || height < 1 || height > kMaxSurfaceSide)
    return c_failure(TP_BAD_ARGUMENT,
                     "a surface of " + std::to_string(width) + "x" + std::to_string(height) + " cannot be");
  const auto pixels = c_format(format);
  if (!pixels) return c_failure(TP_BAD_ARGUMENT, pixels.error().text);
  const auto parsed = c_options(options);
  if (!parsed) return c_failure(TP_BAD_ARGUMENT, parsed.error().text);
  auto specs = parse_list(schemes);
  if (!specs) return c_failure(TP_BAD_SCHEME, specs.error().text);
  out = std::make_unique<tp_engine>(std::move(*specs), *parsed,
                                    SurfaceView{nullptr, 0, width, height, pixels->format, pixels->order});
  return TP_OK;
}

/// Checks what all queries of a scheme's last frame require.
tp_status check_scheme(const tp_engine* engine, uint32_t scheme) {
  if (engine == nullptr) return c_failure(TP_BAD_ARGUMENT, "engine is NULL");
  if (scheme >= engine->specs.size())
    return c_failure(TP_BAD_ARGUMENT, "scheme " + std::to_string(scheme) + ": the engine has " +
                                          std::to_string(engine->specs.size()));
  if (!engine->has_frame) return c_failure(TP_NO_FRAME, "no frame has been pushed");
  return TP_OK;
}

/// The same for queries that need the scheme's bits.
tp_status check_kept(const tp_engine* engine, uint32_t scheme) {
  if (const tp_status status = check_scheme(engine, scheme); status != TP_OK) return status;
  if (engine->surfaces.empty())
    return c_failure(TP_NO_FRAME, "the engine keeps no blocks (open it with keep_blocks = 1)");
  if (engine->frame.schemes[scheme].skipped)
    return c_failure(TP_UNSUPPORTED,
                     "scheme " + engine->specs[scheme].text + " does not support the surface's format");
  return TP_OK;
}

tp_statistics statistics_of(const SchemeStatistics& figures) {
  tp_statistics out{};
  out.skipped = figures.skipped ? 1 : 0;
  out.blocks = figures.blocks;
  out.raw_bits = figures.raw_bits;
  out.payload_bits = figures.payload_bits;
  out.bursts = figures.bursts;
  out.burst_bits = figures.burst_bits;
  out.csb_bits = figures.csb_bits;
  out.table_bits = figures.palette_bits;
  out.extra_bits = figures.extra_bits;
  out.checked_blocks = figures.checked_blocks;
  out.mismatched_blocks = figures.mismatched_blocks;
  std::ranges::copy(figures.own, out.own);
  if (figures.toggles) {
    out.toggles = figures.toggles->plain;
    out.toggles_dbi = figures.toggles->inverted;
    out.raw_toggles = figures.toggles->raw_plain;
    out.raw_toggles_dbi = figures.toggles->raw_inverted;
  }
  if (figures.raw_bits == 0) return out;
  out.rate = figures.rate();
  out.rate_payload = figures.rate_payload();
  out.rate_with_extra = figures.rate_with_extra();
  return out;
}

tp_status push(tp_engine& engine, const void* top_row, ptrdiff_t pitch) {
  const ptrdiff_t row_bytes = ptrdiff_t{engine.shape.width} * traits(engine.shape.format).pixel_bits / 8;
  if (top_row == nullptr) return c_failure(TP_BAD_ARGUMENT, "top_row is NULL");
  if (engine.shape.height > 1 && pitch < row_bytes && pitch > -row_bytes)
    return c_failure(TP_BAD_ARGUMENT, "pitch " + std::to_string(pitch) + ": a row has " +
                                          std::to_string(row_bytes) + " bytes");
  SurfaceView view = engine.shape;
  view.top_row = static_cast<const std::byte*>(top_row);
  view.pitch_bytes = pitch;
  engine.engine.process(view, engine.frame, engine.surfaces);
  engine.has_frame = true;
  if (engine.frame.warmup) return TP_OK;
  for (size_t i = 0; i < engine.totals.size(); ++i) engine.totals[i] += engine.frame.schemes[i];
  return TP_OK;
}

}  // namespace

tp_engine* tp_engine_open(uint32_t width, uint32_t height, uint32_t format, const char* schemes,
                          const tp_options* options) {
  std::unique_ptr<tp_engine> engine;
  const tp_status status =
      c_call([&] { return open_engine(width, height, format, schemes, options, engine); });
  return status == TP_OK ? engine.release() : nullptr;
}

void tp_engine_close(tp_engine* engine) {
  delete engine;
}

uint32_t tp_engine_scheme_count(const tp_engine* engine) {
  return engine == nullptr ? 0 : static_cast<uint32_t>(engine->specs.size());
}

const char* tp_engine_scheme(const tp_engine* engine, uint32_t scheme) {
  return scheme < tp_engine_scheme_count(engine) ? engine->specs[scheme].text.c_str() : nullptr;
}

tp_status tp_engine_push(tp_engine* engine, const void* top_row, ptrdiff_t pitch) {
  if (engine == nullptr) return c_failure(TP_BAD_ARGUMENT, "engine is NULL");
  return c_call([&] { return push(*engine, top_row, pitch); });
}

tp_status tp_engine_statistics(const tp_engine* engine, uint32_t scheme, tp_statistics* out) {
  return c_call([&] {
    const tp_status status = check_scheme(engine, scheme);
    return status != TP_OK ? status : c_fill(out, statistics_of(engine->frame.schemes[scheme]), "out");
  });
}

tp_status tp_engine_totals(const tp_engine* engine, uint32_t scheme, tp_statistics* out) {
  return c_call([&] {
    const tp_status status = check_scheme(engine, scheme);
    return status != TP_OK ? status : c_fill(out, statistics_of(engine->totals[scheme]), "out");
  });
}

tp_status tp_engine_frame(const tp_engine* engine, tp_frame* out) {
  return c_call([&]() -> tp_status {
    if (const tp_status status = check_scheme(engine, 0); status != TP_OK) return status;
    const FrameMetrics& metrics = engine->frame.metrics;
    tp_frame frame{};
    frame.width = engine->shape.width;
    frame.height = engine->shape.height;
    frame.blocks_x = engine->block_bits.blocks_x;
    frame.blocks_y = engine->block_bits.blocks_y;
    frame.raw_block_bits = engine->block_bits.raw_bits;
    frame.number = engine->engine.frames() - 1;
    frame.unique_colors = metrics.unique_colors;
    frame.entropy = metrics.entropy;
    frame.pixel_change = metrics.pixel_change;
    frame.color_change = metrics.color_change;
    frame.fvc_coverage = metrics.fvc_coverage;
    frame.fvc_relative_coverage = metrics.fvc_relative_coverage;
    frame.top100_coverage = metrics.top100_coverage;
    return c_fill(out, frame, "out");
  });
}

tp_status tp_engine_block_bits(const tp_engine* engine, uint32_t scheme, uint16_t* bits, size_t count) {
  return c_call([&]() -> tp_status {
    if (const tp_status status = check_scheme(engine, scheme); status != TP_OK) return status;
    if (bits == nullptr) return c_failure(TP_BAD_ARGUMENT, "bits is NULL");
    const std::vector<uint16_t>& known = engine->block_bits.schemes[scheme];
    if (known.empty())
      return c_failure(TP_UNSUPPORTED,
                       "scheme " + engine->specs[scheme].text + " does not support the surface's format");
    if (count < known.size())
      return c_failure(TP_NO_SPACE, "bits: room for " + std::to_string(count) + " of " +
                                        std::to_string(known.size()) + " blocks");
    std::ranges::copy(known, bits);
    return TP_OK;
  });
}

tp_status tp_engine_encode_block(const tp_engine* engine, uint32_t scheme, uint32_t bx, uint32_t by,
                                 uint8_t* payload, size_t payload_bytes, uint32_t* payload_bits, uint8_t* csb,
                                 size_t csb_bytes, uint32_t* csb_bits) {
  return c_call([&]() -> tp_status {
    if (const tp_status status = check_kept(engine, scheme); status != TP_OK) return status;
    if (payload == nullptr || payload_bits == nullptr || csb == nullptr || csb_bits == nullptr)
      return c_failure(TP_BAD_ARGUMENT, "payload, csb or where their lengths go is NULL");
    const CompressedSurface& surface = engine->surfaces[scheme];
    if (bx >= surface.blocks_x() || by >= surface.blocks_y())
      return c_failure(TP_BAD_ARGUMENT,
                       "there is no block (" + std::to_string(bx) + ", " + std::to_string(by) + ")");
    const uint64_t number = uint64_t{by} * surface.blocks_x() + bx;
    const uint32_t bits = surface.block_bits[number];
    if (payload_bytes < (bits + 7) / 8 || csb_bytes < (surface.csb_bits + 7) / 8)
      return c_failure(TP_NO_SPACE, "the block has " + std::to_string(bits) + " payload bits and " +
                                        std::to_string(surface.csb_bits) + " CSB bits");
    std::memcpy(payload, &surface.payload[number * surface.slot_bytes()], (bits + 7) / 8);
    BitReader plane(surface.csb);
    plane.skip(number * surface.csb_bits);
    BitWriter marks({csb, (surface.csb_bits + 7) / 8});
    for (uint32_t left = surface.csb_bits; left > 0;) {
      const uint32_t count = std::min(left, kMaxBitsPerCall);
      marks.put(plane.get(count), count);
      left -= count;
    }
    marks.flush();
    *payload_bits = bits;
    *csb_bits = surface.csb_bits;
    return TP_OK;
  });
}

tp_status tp_engine_tables(const tp_engine* engine, uint32_t scheme, uint8_t* tables, size_t table_bytes,
                           uint64_t* table_bits) {
  return c_call([&]() -> tp_status {
    if (const tp_status status = check_kept(engine, scheme); status != TP_OK) return status;
    if (table_bits == nullptr) return c_failure(TP_BAD_ARGUMENT, "table_bits is NULL");
    const CompressedSurface& surface = engine->surfaces[scheme];
    *table_bits = surface.table_bits;
    const size_t bytes = surface.tables.size();
    if (bytes > 0 && (tables == nullptr || table_bytes < bytes))
      return c_failure(TP_NO_SPACE, "the tables have " + std::to_string(bytes) + " bytes");
    if (bytes > 0) std::memcpy(tables, surface.tables.data(), bytes);
    return TP_OK;
  });
}
