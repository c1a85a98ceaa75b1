// Scheme sections: means per category, energy, and the paper's figures beside the batch's own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page_parts.h"
#include "published_means.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

bool same_category(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

std::string group_label(const std::string& category, size_t count) {
  return fmt::format("{} ({} workload{})", category_label(category), count, count == 1 ? "" : "s");
}

Section means_section(const Batch& batch, bool with_bursts) {
  Section out;
  out.id = with_bursts ? "means" : "means-payload";
  out.heading = with_bursts ? "Harmonic means per category" : "Harmonic means per category, without bursts";
  out.note =
      with_bursts
          ? "Harmonic mean of the workloads' rates: n / Σ (1 / rate). Bursts, CSB and palettes are counted."
          : "Harmonic mean of the workloads' rates from payload and CSB bits alone, the paper's first "
            "comparison.";
  Table& table = out.table;
  table.id = "table-" + out.id;
  table.caption = out.heading;
  table.header = {"category", "scheme", "workloads", "harmonic mean"};
  table.text_columns = 2;
  std::vector<ChartRow> rows;
  double high = 0;
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      const auto rates = batch.rates(category, batch.schemes[i], with_bursts);
      const double mean = harmonic_mean(rates);
      table.rows.push_back({text_cell(category_label(category)), text_cell(batch.schemes[i]),
                            count_cell(rates.size()), number_cell(mean)});
      if (std::isnan(mean)) continue;
      high = std::max(high, mean);
      rows.push_back(
          {batch.schemes[i],
           group_label(category, rates.size()),
           {{mean, i,
             fmt::format("{}, {}: {}", category_label(category), batch.schemes[i], shown_number(mean))}}});
    }
  // A linear axis always: a bar's length has to mean its value.
  if (high > 0)
    out.chart =
        row_chart(rows, AxisScale::for_rates(0, high), RowShape::kBars,
                  "rate (raw / moved bits), harmonic mean", out.heading + ". The table has all figures.");
  return out;
}

/// Schemes whose further traffic is not in their rate: what the rate would be with it.
Section extra_section(const Batch& batch) {
  Section out{.id = "extra", .heading = "With further traffic"};
  out.note =
      "Some schemes cause traffic that rate leaves out: column extra_bits of schemes.csv, a second pass over "
      "the "
      "frame or checksums. Σ raw / Σ (moved + extra) over a run's frames, and the harmonic mean of the "
      "workloads.";
  Table& table = out.table;
  table.id = "table-extra";
  table.caption = out.heading;
  table.header = {"category", "scheme", "workloads", "harmonic mean", "with further traffic"};
  table.text_columns = 2;
  std::vector<ChartRow> rows;
  double high = 0;
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      std::vector<double> with_extra;
      uint64_t extra_bits = 0;
      for (const RunSummary& run : batch.runs) {
        const size_t at = run.find(batch.schemes[i]);
        if (run.category != category || at == run.schemes.size() || run.measured == 0) continue;
        with_extra.push_back(run.totals[at].rate_with_extra());
        extra_bits += run.totals[at].extra_bits;
      }
      if (extra_bits == 0) continue;
      const double mean = harmonic_mean(with_extra);
      high = std::max(high, mean);
      table.rows.push_back(
          {text_cell(category_label(category)), text_cell(batch.schemes[i]), count_cell(with_extra.size()),
           number_cell(harmonic_mean(batch.rates(category, batch.schemes[i], true))), number_cell(mean)});
      rows.push_back(
          {batch.schemes[i],
           group_label(category, with_extra.size()),
           {{mean, i,
             fmt::format("{}, {}: {}", category_label(category), batch.schemes[i], shown_number(mean))}}});
    }
  if (rows.empty()) {
    out.heading.clear();
    return out;
  }
  out.chart = row_chart(rows, AxisScale::for_rates(0, high), RowShape::kBars,
                        "raw / (moved + extra) bits, harmonic mean",
                        out.heading + ". The table has all figures.");
  return out;
}

/// DCP's structures are the only ones the paper gives an energy for.
bool has_dcp_structures(const std::string& scheme) {
  const SchemeInfo* info = find_scheme(scheme.substr(0, scheme.find(':')));
  return info != nullptr && info->has_dcp_structures;
}

Section energy_section(const Batch& batch) {
  const EnergyModel& model = batch.energy;
  Section out{.id = "energy", .heading = "Energy saving"};
  out.note = fmt::format(
      "saving = 1 − 1/rate − {0}/{1}: {1} pJ per byte moved in DRAM, {0} pJ per raw byte for DCP's "
      "structures, static and dynamic; rate "
      "is the category's harmonic mean. RAS's and RED's own hardware is not in the paper: they are left out, "
      "and HDCP's figure holds DCP's "
      "part only. The paper's 199.6 mW is the dynamic power of its own display: 720×1280 RGBA8 written and "
      "read 60 times a second, 442.37 MB/s × 451.2 pJ/B. The other 429.8 mW of its 629.4 mW are static.",
      model.dcp_pj_per_byte, model.dram_pj_per_byte);
  Table& table = out.table;
  table.id = "table-energy";
  table.caption = "Energy saved, share of the DRAM energy of raw frames";
  table.header = {"category", "scheme", "rate", "saving", "published"};
  table.text_columns = 2;
  std::vector<ChartRow> rows;
  for (const std::string& category : batch.categories)
    for (size_t i = 0; i < batch.schemes.size(); ++i) {
      const std::string& scheme = batch.schemes[i];
      if (!has_dcp_structures(scheme)) continue;
      const auto rates = batch.rates(category, scheme, true);
      const double rate = harmonic_mean(rates);
      if (std::isnan(rate)) continue;
      const double saving = model.saving(rate);
      double published = NAN;
      for (const PublishedSaving& figure : kPublishedSavings)
        if (scheme == "vdcp" && same_category(figure.category, category)) published = figure.saving;
      rows.push_back(
          {scheme,
           group_label(category, rates.size()),
           {{std::max(0.0, saving * 100), i,
             fmt::format("{}, {}: {}", category_label(category), scheme, shown_percent(saving))}}});
      table.rows.push_back({text_cell(category_label(category)), text_cell(scheme), number_cell(rate),
                            percent_cell(saving), percent_cell(published)});
    }
  if (rows.empty()) {
    out.heading.clear();
    return out;
  }
  out.chart = row_chart(rows, AxisScale::linear(100, 20), RowShape::kBars, "energy saved in percent",
                        "Energy saved. The table has all figures.");
  return out;
}

Section published_section(const Batch& batch) {
  Section out{.id = "published", .heading = "Beside the paper's published means"};
  out.note =
      "The paper's figures are means over its own 124 Android workloads (92 UI, 20 2D, 12 3D; 720×1280). The "
      "figures of this report come "
      "from the runs listed above and from nothing else; they are the same workloads only if you captured "
      "those. The abstract and the "
      "conclusion of the paper give further percentages that do not agree with each other; the figures here "
      "are those of its evaluation.";
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

}  // namespace

std::vector<Section> scheme_sections(const Batch& batch) {
  std::vector<Section> out = {means_section(batch, true), means_section(batch, false), extra_section(batch),
                              energy_section(batch), published_section(batch)};
  std::erase_if(out, [](const Section& section) { return section.heading.empty(); });
  return out;
}

}  // namespace tilepress
