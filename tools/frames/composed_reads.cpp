// Composed reads: one table row per layer, and one for all.
#include "frames/composed_reads.h"

#include <fmt/format.h>

#include "counted.h"
#include "tilepress/csv_table.h"

namespace tilepress {

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
