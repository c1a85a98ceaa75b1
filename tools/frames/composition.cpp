// Composition: visibility by cutting rectangles, then one read of each visible block.
#include "frames/composition.h"

#include <fmt/format.h>

#include <algorithm>

#include "counted.h"
#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

/// Half-open box on the screen.
struct Box {
  int64_t left, top, right, bottom;
  bool empty() const { return left >= right || top >= bottom; }
};

Box cut(const Box& a, const Box& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

Box place(const Layer& layer) {
  return {layer.x, layer.y, int64_t{layer.x} + layer.surface.width, int64_t{layer.y} + layer.surface.height};
}

/// Whether every pixel of `box` lies inside a cover.
bool covered(const Box& box, const Box* covers, size_t count) {
  if (box.empty()) return true;
  if (count == 0) return false;
  const Box common = cut(box, covers[0]);
  if (common.empty()) return covered(box, covers + 1, count - 1);
  const Box parts[] = {{box.left, box.top, box.right, common.top},
                       {box.left, common.bottom, box.right, box.bottom},
                       {box.left, common.top, common.left, common.bottom},
                       {common.right, common.top, box.right, common.bottom}};
  return std::all_of(std::begin(parts), std::end(parts),
                     [&](const Box& part) { return covered(part, covers + 1, count - 1); });
}

/// Decides which blocks of one layer are read.
class Visibility {
 public:
  Visibility(const std::vector<Layer>& layers, size_t index, const CompositionOptions& options)
      : layer_(layers[index]), screen_{0, 0, options.width, options.height} {
    for (size_t above = index + 1; above < layers.size() && options.skip_hidden; ++above)
      if (layers[above].opaque()) covers_.push_back(place(layers[above]));
  }

  /// Counts the block in `out` if it is not visible.
  bool is_visible(uint32_t bx, uint32_t by, LayerTraffic& out) const {
    const int64_t left = int64_t{layer_.x} + bx * kBlockSide, top = int64_t{layer_.y} + by * kBlockSide;
    // The padding of a block at the surface's edge is no pixel.
    const Box box = cut(cut({left, top, left + kBlockSide, top + kBlockSide}, place(layer_)), screen_);
    const bool outside = box.empty();
    const bool hidden = !outside && covered(box, covers_.data(), covers_.size());
    out.outside_blocks += outside;
    out.hidden_blocks += hidden;
    return !outside && !hidden;
  }

 private:
  const Layer& layer_;
  const Box screen_;
  std::vector<Box> covers_;
};

Result<LayerTraffic> read_layer(const CompressedSurface& surface, const CompositionOptions& options,
                                const Visibility& visibility) {
  LayerTraffic out;
  SurfaceReader reader;
  if (options.note_fetches) reader.note_fetches(&out.fetches);
  bool open = false;
  Block block;
  for (uint32_t by = 0; by < surface.blocks_y(); ++by)
    for (uint32_t bx = 0; bx < surface.blocks_x(); ++bx) {
      if (!visibility.is_visible(bx, by, out)) continue;
      // A surface without a visible block needs not even its tables.
      if (!open)
        if (const auto opened = reader.open(surface, options.read); !opened) return opened.error();
      open = true;
      if (!reader.read_block(bx, by, block)) return Error{ErrorKind::kBadBits, "bits that no encoder writes"};
    }
  if (open) out.traffic = reader.traffic();
  return out;
}

}  // namespace

Result<std::vector<LayerTraffic>> read_composition(const std::vector<Layer>& layers,
                                                   const CompositionOptions& options) {
  std::vector<LayerTraffic> out;
  for (size_t i = 0; i < layers.size(); ++i) {
    auto read = read_layer(layers[i].surface, options, Visibility(layers, i, options));
    if (!read) return about("surface " + std::to_string(i), read.error());
    out.push_back(std::move(*read));
  }
  return out;
}

ReadTotals& ReadTotals::operator+=(const ReadTotals& other) {
  blocks += other.blocks;
  hidden += other.hidden;
  payload_bits += other.payload_bits;
  csb_bits += other.csb_bits;
  table_bits += other.table_bits;
  raw_bits += other.raw_bits;
  return *this;
}

ReadTotals totals_of(const LayerTraffic& layer, uint32_t burst_bits) {
  return {.blocks = layer.traffic.blocks,
          .hidden = layer.hidden_blocks,
          .payload_bits = layer.traffic.payload_bursts * burst_bits,
          .csb_bits = layer.traffic.csb_bursts * burst_bits,
          .table_bits = layer.traffic.table_bursts * burst_bits,
          .raw_bits = layer.traffic.raw_bursts * burst_bits};
}

namespace {

struct Row {
  uint64_t frame;
  size_t surface;
  const std::string& file;
  const Layer& layer;
  const LayerTraffic& read;
  ReadTotals sum;
};
constexpr CsvColumn<Row> kColumns[] = {
    csv_column<Row, &Row::frame>("frame"),
    csv_column<Row, &Row::surface>("surface"),
    TILEPRESS_CSV_FIGURE("file", row.file),
    TILEPRESS_CSV_FIGURE("scheme", row.layer.surface.scheme.text),
    TILEPRESS_CSV_FIGURE("x", row.layer.x),
    TILEPRESS_CSV_FIGURE("y", row.layer.y),
    TILEPRESS_CSV_FIGURE("width", row.layer.surface.width),
    TILEPRESS_CSV_FIGURE("height", row.layer.surface.height),
    TILEPRESS_CSV_FIGURE("blocks", row.sum.blocks),
    TILEPRESS_CSV_FIGURE("hidden_blocks", row.sum.hidden),
    TILEPRESS_CSV_FIGURE("outside_blocks", row.read.outside_blocks),
    TILEPRESS_CSV_FIGURE("burst_bits", row.layer.surface.burst_bits),
    TILEPRESS_CSV_FIGURE("payload_bursts", row.read.traffic.payload_bursts),
    TILEPRESS_CSV_FIGURE("csb_bursts", row.read.traffic.csb_bursts),
    TILEPRESS_CSV_FIGURE("table_bursts", row.read.traffic.table_bursts),
    TILEPRESS_CSV_FIGURE("raw_bursts", row.read.traffic.raw_bursts),
    TILEPRESS_CSV_FIGURE("moved_bits", row.sum.moved_bits()),
    TILEPRESS_CSV_FIGURE("raw_bits", row.sum.raw_bits),
    TILEPRESS_CSV_FIGURE("rate", row.sum.rate()),
};

}  // namespace

std::string composed_csv_header() {
  return csv_header(kColumns);
}

std::string composed_csv_row(uint64_t frame, size_t surface, const std::string& file, const Layer& layer,
                             const LayerTraffic& read) {
  std::string out;
  append_csv_row(kColumns, Row{frame, surface, file, layer, read, totals_of(read, layer.surface.burst_bits)},
                 out);
  return out;
}

std::string composed_table(const ComposedSummary& summary, const CompositionOptions& options) {
  std::string out =
      fmt::format("{} on {}x{} at {:g} Hz, {}{}\n", counted(summary.files.size(), "surface"), options.width,
                  options.height, summary.refresh_hz, counted(summary.frames, "frame"),
                  summary.without_first ? " (without the first, which has no dictionary yet)" : "");
  out += fmt::format("  {:>10} {:>10} {:>10} {:>10} {:>10} {:>8}  {}\n", "raw MB/s", "MB/s", "payload", "CSB",
                     "tables", "rate", "surface");
  const auto add_line = [&](const ReadTotals& sum, const std::string& name) {
    const auto bandwidth = [&](uint64_t bits) {
      return static_cast<double>(bits) / 8 / static_cast<double>(summary.frames) * summary.refresh_hz / 1e6;
    };
    out += fmt::format("  {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.3f}  {}\n",
                       bandwidth(sum.raw_bits), bandwidth(sum.moved_bits()), bandwidth(sum.payload_bits),
                       bandwidth(sum.csb_bits), bandwidth(sum.table_bits), sum.rate(), name);
  };
  ReadTotals all;
  for (size_t i = 0; i < summary.files.size(); ++i) {
    add_line(summary.totals[i], summary.files[i]);
    all += summary.totals[i];
  }
  add_line(all, "all");
  if (options.skip_hidden)
    out += fmt::format("  {} read, {} hidden and left out\n", counted(all.blocks, "block"), all.hidden);
  return out;
}

}  // namespace tilepress
