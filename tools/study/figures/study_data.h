// Study data: the files of a finished study, and look-ups in them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "study/figures/study_spec.h"
#include "study/figures/study_table.h"

namespace tilepress {

/// The category of means.csv that holds every workload.
inline constexpr const char* kAllCategories = "all";

class StudyData {
 public:
  StudySpec spec;
  StudyTable results, means, workloads, frame_metrics, color_cdf, frame_rates, bounds, bound_means, sensitivity;
  /// What rendered the frames, from provenance.json: name and distinct values.
  std::vector<std::pair<std::string, std::string>> facts;

  /// A key's value in a row of results.csv. The FVC's default associativity is "full".
  std::string key_text(size_t row, const std::string& key) const;
  /// A number of results.csv, or of means.csv; NaN without the row.
  double result(const std::string& workload, const std::string& configuration, std::string_view column) const;
  double mean(const std::string& category, const std::string& configuration, std::string_view column) const;

  /// The bounds of the study, as bound_means.csv names them. Empty without that file.
  std::vector<std::string> bound_names() const { return bound_means.distinct("bound"); }
  /// A number of bounds.csv, or of bound_means.csv; NaN without the row.
  double bound(const std::string& workload, const std::string& name, std::string_view column) const;
  double bound_mean(const std::string& category, const std::string& name, std::string_view column) const;

  /// Categories of means.csv in the study's order. kAllCategories stands last, or alone.
  const std::vector<std::string>& categories() const { return categories_; }
  /// The study's own spelling of a category: "ui" where a paper writes "UI". `name` itself if there is none.
  std::string spelled_category(const std::string& name) const;
  /// The title that the study gives a category.
  std::string category_title(const std::string& category) const;
  /// Rows of workloads.csv with results, in the paper's order: by category, within a category by
  /// rate_payload of DCP (or of the first configuration), smallest first.
  const std::vector<size_t>& ordered_workloads() const { return ordered_workloads_; }
  /// Those of a category; all of kAllCategories.
  std::vector<size_t> workloads_of(const std::string& category) const;
  /// Configurations of results.csv in the study's order.
  const std::vector<std::string>& configurations() const { return configurations_; }

  /// Fills the look-ups from the tables.
  void index();

 private:
  using Pair = std::pair<std::string, std::string>;
  static double number_in(const StudyTable& table, const std::map<Pair, size_t>& rows, const Pair& subject,
                          std::string_view column);
  void index_means();
  void order_workloads();
  std::map<Pair, size_t> result_rows_, mean_rows_;
  std::vector<std::string> categories_, configurations_;
  std::vector<size_t> ordered_workloads_;
};

/// Reads the files of a study folder. results.csv, means.csv, workloads.csv and study.json must exist.
Result<StudyData> read_study_data(const std::string& study_folder);

}  // namespace tilepress
