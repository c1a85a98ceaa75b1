// Energy section: the share of DRAM energy that each category's mean rate saves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "category_bars.h"
#include "published_means.h"
#include "scheme_names.h"
#include "sections.h"

namespace tilepress {

Section energy_section(const Batch& batch) {
  Section out{.id = "energy", .heading = "Energy saving"};
  out.note = fmt::format(
      "saving = 1 − 1/rate − {0}/{1}. DRAM takes {1} pJ per byte moved. DCP's structures take {0} pJ per raw "
      "byte, static and dynamic. The rate is the category's harmonic mean. The paper has no energy for the "
      "hardware of RAS and RED: this table leaves them out, and for HDCP it counts DCP's structures only. "
      "The "
      "paper's 199.6 mW is the dynamic power of its own display: 720×1280 RGBA8, written and read 60 times a "
      "second, 442.37 MB/s × 451.2 pJ/B. The other 429.8 mW of its 629.4 mW are static.",
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
      if (!has_dcp_structures(scheme)) continue;
      const auto rates = batch.rates(category, scheme, true);
      const double rate = harmonic_mean(rates);
      if (std::isnan(rate)) continue;
      const double saving = energy_saving(rate, batch.energy);
      double published = NAN;
      for (const PublishedSaving& figure : kPublishedSavings)
        if (scheme == figure.scheme && same_category(figure.category, category)) published = figure.saving;
      bars.add(category, i, rates.size(), std::max(0.0, saving * 100), shown_percent(saving));
      table.rows.push_back({text_cell(category_label(category)), text_cell(scheme), number_cell(rate),
                            percent_cell(saving), percent_cell(published)});
    }
  if (bars.empty()) return {};
  out.chart = bars.percent_chart("energy saved in percent", "Energy saved. The table has all figures.");
  return out;
}

}  // namespace tilepress
