// Means sections: harmonic means per category, what they save, and the paper's own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "counted.h"
#include "published_means.h"
#include "scheme_names.h"
#include "sections.h"

namespace tilepress {
namespace {

constexpr const char* kAllFigures = ". The table has all figures.";

/// A bar and a table row per category and scheme.
class CategoryBars {
 public:
  explicit CategoryBars(const Batch& batch) : batch_(batch) {}
  /// `scheme`: index in the batch. `shown`: the value as text.
  void add(const std::string& category, size_t scheme, size_t workloads, double value,
           const std::string& shown) {
    const std::string label = category_label(category);
    high_ = std::max(high_, value);
    rows_.push_back({batch_.schemes[scheme],
                     fmt::format("{} ({})", label, counted(workloads, "workload")),
                     {{value, scheme, fmt::format("{}, {}: {}", label, batch_.schemes[scheme], shown)}}});
  }
  bool empty() const { return rows_.empty(); }
  /// The axis is linear, because the length of a bar has to show its value.
  std::string rate_chart(const std::string& unit, const std::string& described) const {
    return row_chart(rows_, AxisScale::for_rates(0, high_), RowShape::kBars, unit, described);
  }
  std::string percent_chart(const std::string& unit, const std::string& described) const {
    return row_chart(rows_, AxisScale::linear(100, 20), RowShape::kBars, unit, described);
  }

 private:
  const Batch& batch_;
  std::vector<ChartRow> rows_;
  double high_ = 0;
};

}  // namespace

Section means_section(const Batch& batch, bool with_bursts) {
  Section out;
  out.id = with_bursts ? "means" : "means-payload";
  out.heading = with_bursts ? "Harmonic means per category" : "Harmonic means per category, without bursts";
  out.note = with_bursts
                 ? "Harmonic mean of the workloads' rates: n / Σ (1 / rate). Bursts, CSB and palettes count."
                 : "Harmonic mean of the workloads' rates. Only payload and CSB bits count: the paper's "
                   "first comparison.";
  Table& table = out.table;
  table.id = "table-" + out.id;
  table.caption = out.heading;
  table.header = {"category", "scheme", "workloads", "harmonic mean"};
  table.text_columns = 2;
  CategoryBars bars(batch);
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      const auto rates = batch.rates(category, batch.schemes[i], with_bursts);
      const double mean = harmonic_mean(rates);
      table.rows.push_back({text_cell(category_label(category)), text_cell(batch.schemes[i]),
                            count_cell(rates.size()), number_cell(mean)});
      if (!std::isnan(mean)) bars.add(category, i, rates.size(), mean, shown_number(mean));
    }
  if (!bars.empty())
    out.chart = bars.rate_chart("rate (raw / moved bits), harmonic mean", out.heading + kAllFigures);
  return out;
}

Section extra_section(const Batch& batch) {
  Section out{.id = "extra", .heading = "With further traffic"};
  out.note =
      "Some schemes cause traffic that the rate leaves out, such as a second pass over the frame or "
      "checksums: column extra_bits of schemes.csv. Here the rate of a run is Σ raw / Σ (moved + extra).";
  Table& table = out.table;
  table.id = "table-extra";
  table.caption = out.heading;
  table.header = {"category", "scheme", "workloads", "harmonic mean", "with further traffic"};
  table.text_columns = 2;
  CategoryBars bars(batch);
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      const std::string& scheme = batch.schemes[i];
      std::vector<double> with_extra;
      uint64_t extra_bits = 0;
      for (const RunSummary& run : batch.runs) {
        const size_t at = run.find(scheme);
        if (run.category != category || at == run.schemes.size() || run.measured == 0) continue;
        with_extra.push_back(run.totals[at].rate_with_extra());
        extra_bits += run.totals[at].extra_bits;
      }
      if (extra_bits == 0) continue;
      const double mean = harmonic_mean(with_extra);
      table.rows.push_back(
          {text_cell(category_label(category)), text_cell(scheme), count_cell(with_extra.size()),
           number_cell(harmonic_mean(batch.rates(category, scheme, true))), number_cell(mean)});
      bars.add(category, i, with_extra.size(), mean, shown_number(mean));
    }
  if (bars.empty()) return {};
  out.chart = bars.rate_chart("raw / (moved + extra) bits, harmonic mean", out.heading + kAllFigures);
  return out;
}

Section energy_section(const Batch& batch) {
  Section out{.id = "energy", .heading = "Energy saving"};
  out.note = fmt::format(
      "saving = 1 − 1/rate − {0}/{1}. DRAM takes {1} pJ per byte moved. DCP's structures take {0} pJ per raw "
      "byte, static and dynamic. The paper's 4.83 pJ hold for 64 entries; nothing is scaled to other sizes. "
      "The rate is the category's harmonic mean. The paper has no energy for the "
      "hardware of RAS and RED: this table leaves them out, and for HDCP it counts DCP's structures only. "
      "The paper's 199.6 mW is the dynamic power of its own display: 720×1280 RGBA8, written and read 60 "
      "times a second, 442.37 MB/s × 451.2 pJ/B. The other 429.8 mW of its 629.4 mW are static.",
      batch.energy.structures_pj_per_byte, batch.energy.dram_pj_per_byte);
  Table& table = out.table;
  table.id = "table-energy";
  table.caption = "Energy saved, as a share of the DRAM energy of raw frames";
  table.header = {"category", "scheme", "rate", "saving", "published"};
  table.text_columns = 2;
  CategoryBars bars(batch);
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      const std::string& scheme = batch.schemes[i];
      const auto rates = batch.rates(category, scheme, true);
      const double rate = harmonic_mean(rates);
      const auto saving = scheme_saving(scheme, rate, batch.energy);
      if (!saving || std::isnan(rate)) continue;
      double published = NAN;
      for (const PublishedSaving& figure : kPublishedSavings)
        if (scheme == figure.scheme && same_category(figure.category, category)) published = figure.saving;
      bars.add(category, i, rates.size(), std::max(0.0, *saving * 100), shown_percent(*saving));
      table.rows.push_back({text_cell(category_label(category)), text_cell(scheme), number_cell(rate),
                            percent_cell(*saving), percent_cell(published)});
    }
  if (bars.empty()) return {};
  out.chart = bars.percent_chart("energy saved in percent", "Energy saved. The table has all figures.");
  return out;
}

Section published_section(const Batch& batch) {
  Section out{.id = "published", .heading = "Beside the paper's published means"};
  out.note =
      "The paper's figures are means over its own 124 Android workloads (92 UI, 20 2D, 12 3D; 720×1280). "
      "This report's figures come only from the runs above. The abstract and the conclusion of the paper "
      "have other percentages, which do not agree with each other. The figures here are those of the paper's "
      "evaluation.";
  Table& table = out.table;
  table.id = "table-published";
  table.caption = "Published mean, this report's mean of the same category, and of all its runs";
  table.header = {"category",    "scheme",         "accounting",           "published mean",
                  "this report", "workloads here", "this report, all runs"};
  table.text_columns = 3;
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
