// Workload tables: columns of frames.csv by their table, without times.
#include "workload_tables.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "tilepress/csv_table.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

/// Means over the measured frames, in the order of the columns of workloads.csv.
struct MetricMeans {
  MeanOverFrames unique_colors, entropy, pixel_change, color_change, fvc_coverage, fvc_relative_coverage,
      top100_coverage;
  std::set<uint32_t> surfaces;
  uint64_t frames = 0;

  explicit MetricMeans(const std::vector<FrameStatistics>& list) : frames(list.size()) {
    for (const FrameStatistics& frame : list) {
      surfaces.insert(frame.surface);
      if (frame.warmup) continue;
      unique_colors.add(static_cast<double>(frame.metrics.unique_colors));
      entropy.add(frame.metrics.entropy);
      pixel_change.add(frame.metrics.pixel_change);
      color_change.add(frame.metrics.color_change);
      fvc_coverage.add(frame.metrics.fvc_coverage);
      fvc_relative_coverage.add(frame.metrics.fvc_relative_coverage);
      top100_coverage.add(frame.metrics.top100_coverage);
    }
  }
};

namespace workload_csv {
struct Row {
  const Workload& workload;
  const WorkloadResults& results;
  const MetricMeans& means;
};
template <auto figure>
constexpr CsvColumn<Row> mean_column(std::string_view name) {
  return {name, [](const Row& row, std::string& out) {
            if (const auto mean = std::invoke(figure, row.means).mean()) out += csv_number(*mean);
          }};
}
/// Of the first frame; empty without frames.
template <auto figure>
constexpr CsvColumn<Row> shape_column(std::string_view name) {
  return {name, [](const Row& row, std::string& out) {
            if (!row.results.frames.empty()) append_csv(out, figure(row.results.frames.front()));
          }};
}
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("workload", row.workload.name),
    TILEPRESS_CSV_FIGURE("category", row.workload.category),
    TILEPRESS_CSV_FIGURE("status", row.results.record.state),
    TILEPRESS_CSV_FIGURE("reason", row.results.record.reason),
    TILEPRESS_CSV_FIGURE("source", row.results.record.source),
    TILEPRESS_CSV_FIGURE("frames", row.means.frames),
    TILEPRESS_CSV_FIGURE("surfaces", row.means.surfaces.size()),
    shape_column<[](const FrameStatistics& frame) { return frame.width; }>("width"),
    shape_column<[](const FrameStatistics& frame) { return frame.height; }>("height"),
    shape_column<[](const FrameStatistics& frame) { return traits(frame.format).name; }>("format"),
    mean_column<&MetricMeans::unique_colors>("unique_colors"),
    mean_column<&MetricMeans::entropy>("entropy"),
    mean_column<&MetricMeans::pixel_change>("pixel_change"),
    mean_column<&MetricMeans::color_change>("color_change"),
    mean_column<&MetricMeans::fvc_coverage>("fvc_coverage"),
    mean_column<&MetricMeans::fvc_relative_coverage>("fvc_relative_coverage"),
    mean_column<&MetricMeans::top100_coverage>("top100_coverage"),
};
}  // namespace workload_csv

std::vector<CsvColumn<FrameStatistics>> metric_columns() {
  std::vector<CsvColumn<FrameStatistics>> columns;
  for (const auto& column : frame_columns())
    if (!column.name.ends_with("_ns")) columns.push_back(column);
  return columns;
}

/// "workload,category," of each row of a long table.
std::string subject_of(const Workload& workload) {
  std::string out;
  append_csv(out, workload.name);
  append_csv(out += ',', workload.category);
  return out += ',';
}

}  // namespace

std::string workloads_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = csv_header(workload_csv::kColumns);
  for (size_t i = 0; i < results.size(); ++i) {
    const MetricMeans means(results[i].frames);
    append_csv_row(workload_csv::kColumns, workload_csv::Row{plan.workloads[i], results[i], means}, out);
  }
  return out;
}

std::string frame_metrics_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  const auto columns = metric_columns();
  std::string out = "workload,category," + csv_header(columns);
  for (size_t i = 0; i < results.size(); ++i)
    for (const FrameStatistics& frame : results[i].frames)
      append_csv_row(columns, frame, out += subject_of(plan.workloads[i]));
  return out;
}

std::string color_cdf_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "workload,category,colors,pixels_share\n";
  for (size_t i = 0; i < results.size(); ++i) {
    std::istringstream lines(results[i].colors);
    std::string line;
    std::getline(lines, line);  // the header
    while (std::getline(lines, line)) out += subject_of(plan.workloads[i]) + line + "\n";
  }
  return out;
}

std::string frame_rates_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "workload,category,frame,surface,configuration,rate,rate_payload,fvc_coverage\n";
  for (size_t i = 0; i < results.size(); ++i)
    for (const auto& sums : results[i].sums)
      for (const ResultFrame& frame : sums ? sums->each : std::vector<ResultFrame>()) {
        append_csv(out += subject_of(plan.workloads[i]), frame.frame);
        append_csv(out += ',', frame.surface);
        append_csv(out += ',', plan.study.baseline);
        append_csv(out += ',', frame.rate);
        append_csv(out += ',', frame.rate_payload);
        out += ',';
        if (frame.fvc_coverage) out += csv_number(*frame.fvc_coverage);
        out += '\n';
      }
  return out;
}

}  // namespace tilepress
