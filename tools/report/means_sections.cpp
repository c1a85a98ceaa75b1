// Means sections: harmonic means per category, what they save, and the paper's own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "counted.h"
#include "published_means.h"
#include "scheme_names.h"
#include "sections.h"

namespace tilepress {
namespace {

/// The cells of a row after category and scheme, and its bar.
struct CategoryRow {
  std::vector<Cell> cells;
  size_t workloads = 0;
  double value = NAN;  ///< of the bar; NaN: no bar
  std::string shown;   ///< the value as text
};

/// Fills the table and the chart with a row per category and scheme that row_of() has one for. `top`: of the
/// axis; 0: as for rates. The axis is linear, because the length of a bar has to show its value.
template <class RowOf>
void fill_section(const Batch& batch, const RowOf& row_of, double top, const std::string& unit,
                  const std::string& described, Section& out) {
  std::vector<ChartRow> bars;
  double high = 0;
  out.table.text_columns = 2;
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      const std::string label = category_label(category), &scheme = batch.schemes[i];
      const std::optional<CategoryRow> row = row_of(category, scheme);
      if (!row) continue;
      auto& cells = out.table.rows.emplace_back(std::vector{text_cell(label), text_cell(scheme)});
      cells.insert(cells.end(), row->cells.begin(), row->cells.end());
      if (std::isnan(row->value)) continue;
      high = std::max(high, row->value);
      bars.push_back({scheme,
                      fmt::format("{} ({})", label, counted(row->workloads, "workload")),
                      {{row->value, i, fmt::format("{}, {}: {}", label, scheme, row->shown)}}});
    }
  const AxisScale axis = top > 0 ? AxisScale::linear(top, top / 5) : AxisScale::for_rates(0, high);
  if (!bars.empty())
    out.chart = row_chart(bars, axis, RowShape::kBars, unit, described + ". The table has all figures.");
}

}  // namespace

Section means_section(const Batch& batch, bool with_bursts) {
  Section out{.heading = with_bursts ? "Harmonic means per category"
                                     : "Harmonic means per category, without bursts"};
  out.note = with_bursts
                 ? "Harmonic mean of the workloads' rates: n / Σ (1 / rate). Bursts, CSB and palettes count."
                 : "Harmonic mean of the workloads' rates. Only payload and CSB bits count: the paper's "
                   "first comparison.";
  out.table = {.name = with_bursts ? "means" : "means-payload",
               .caption = out.heading,
               .header = {"category", "scheme", "workloads", "harmonic mean"}};
  const auto row_of = [&](const std::string& category,
                          const std::string& scheme) -> std::optional<CategoryRow> {
    const auto rates = batch.rates(category, scheme, with_bursts);
    const double mean = harmonic_mean(rates);
    return CategoryRow{{count_cell(rates.size()), number_cell(mean)}, rates.size(), mean, shown_number(mean)};
  };
  fill_section(batch, row_of, 0, "rate (raw / moved bits), harmonic mean", out.heading, out);
  return out;
}

Section extra_section(const Batch& batch) {
  Section out{.heading = "With further traffic"};
  out.note =
      "Some schemes cause traffic that the rate leaves out, such as a second pass over the frame or "
      "checksums: column extra_bits of schemes.csv. Here the rate of a run is Σ raw / Σ (moved + extra).";
  out.table = {.name = "extra",
               .caption = out.heading,
               .header = {"category", "scheme", "workloads", "harmonic mean", "with further traffic"}};
  const auto row_of = [&](const std::string& category,
                          const std::string& scheme) -> std::optional<CategoryRow> {
    std::vector<double> with_extra;
    uint64_t extra_bits = 0;
    for (const RunSummary& run : batch.runs) {
      const size_t at = run.find(scheme);
      if (run.category != category || at == run.schemes.size() || run.measured == 0) continue;
      with_extra.push_back(run.totals[at].rate_with_extra());
      extra_bits += run.totals[at].extra_bits;
    }
    if (extra_bits == 0) return std::nullopt;
    const double mean = harmonic_mean(with_extra);
    const double plain = harmonic_mean(batch.rates(category, scheme, true));
    return CategoryRow{{count_cell(with_extra.size()), number_cell(plain), number_cell(mean)},
                       with_extra.size(),
                       mean,
                       shown_number(mean)};
  };
  fill_section(batch, row_of, 0, "raw / (moved + extra) bits, harmonic mean", out.heading, out);
  return out.chart.empty() ? Section() : out;
}

Section energy_section(const Batch& batch) {
  Section out{.heading = "Energy saving"};
  out.note = fmt::format(
      "saving = 1 − 1/rate − {0}/{1}. DRAM takes {1} pJ per byte moved. DCP's structures take {0} pJ per raw "
      "byte, static and dynamic. The paper's 4.83 pJ hold for 64 entries; nothing is scaled to other sizes. "
      "The rate is the category's harmonic mean. The paper has no energy for the "
      "hardware of RAS and RED: this table leaves them out, and for HDCP it counts DCP's structures only. "
      "The paper's 199.6 mW is the dynamic power of its own display: 720×1280 RGBA8, written and read 60 "
      "times a second, 442.37 MB/s × 451.2 pJ/B. The other 429.8 mW of its 629.4 mW are static.",
      batch.energy.structures_pj_per_byte, batch.energy.dram_pj_per_byte);
  out.table = {.name = "energy",
               .caption = "Energy saved, as a share of the DRAM energy of raw frames",
               .header = {"category", "scheme", "rate", "saving", "published"}};
  const auto row_of = [&](const std::string& category,
                          const std::string& scheme) -> std::optional<CategoryRow> {
    const auto rates = batch.rates(category, scheme, true);
    const double rate = harmonic_mean(rates);
    const auto saving = scheme_saving(scheme, rate, batch.energy);
    if (!saving || std::isnan(rate)) return std::nullopt;
    return CategoryRow{
        {number_cell(rate), percent_cell(*saving), percent_cell(published_saving(scheme, category))},
        rates.size(),
        std::max(0.0, *saving * 100),
        shown_percent(*saving)};
  };
  fill_section(batch, row_of, 100, "energy saved in percent", "Energy saved", out);
  return out.chart.empty() ? Section() : out;
}

Section published_section(const Batch& batch) {
  Section out{.heading = "Beside the paper's published means"};
  out.note =
      "The paper's figures are means over its own 124 Android workloads (92 UI, 20 2D, 12 3D; 720×1280). "
      "This report's figures come only from the runs above. The abstract and the conclusion of the paper "
      "have other percentages, which do not agree with each other. The figures here are those of the paper's "
      "evaluation.";
  Table& table = out.table;
  table = {.name = "published",
           .caption = "Published mean, this report's mean of the same category, and of all its runs",
           .header = {"category", "scheme", "accounting", "published mean", "this report", "workloads here",
                      "this report, all runs"},
           .text_columns = 3};
  for (const PublishedMean& figure : kPublishedMeans) {
    std::vector<double> own, all;
    const std::string scheme(figure.scheme);
    for (const std::string& category : batch.categories) {
      const auto rates = batch.rates(category, scheme, figure.with_bursts);
      all.insert(all.end(), rates.begin(), rates.end());
      if (same_category(category, figure.category)) own.insert(own.end(), rates.begin(), rates.end());
    }
    table.rows.push_back({text_cell(figure.category), text_cell(scheme),
                          text_cell(figure.with_bursts ? "with bursts" : "without bursts"),
                          number_cell(figure.mean), number_cell(harmonic_mean(own)), count_cell(own.size()),
                          number_cell(harmonic_mean(all))});
  }
  return out;
}

}  // namespace tilepress
