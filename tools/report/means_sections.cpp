// Means sections: harmonic means per category.
#include <cmath>

#include "category_bars.h"
#include "sections.h"

namespace tilepress {
namespace {

constexpr const char* kAllFigures = ". The table has all figures.";

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
      "checksums: "
      "column extra_bits of schemes.csv. Here the rate of a run is Σ raw / Σ (moved + extra).";
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

}  // namespace tilepress
