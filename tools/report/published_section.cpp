// Published section: the paper's means and the batch's own.
#include "category_bars.h"
#include "published_means.h"
#include "sections.h"

namespace tilepress {

Section published_section(const Batch& batch) {
  Section out{.id = "published", .heading = "Beside the paper's published means"};
  out.note =
      "The paper's figures are means over its own 124 Android workloads (92 UI, 20 2D, 12 3D; 720×1280). "
      "This "
      "report's figures come only from the runs above. The abstract and the conclusion of the paper have "
      "other "
      "percentages, which do not agree with each other. The figures here are those of the paper's "
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
