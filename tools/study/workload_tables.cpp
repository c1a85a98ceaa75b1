// Workload tables: columns of frames.csv by their table, without times.
#include "study_tables.h"

#include <set>
#include <sstream>

#include "tilepress/csv_table.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

size_t count_surfaces(const std::vector<FrameStatistics>& frames) {
  std::set<uint32_t> surfaces;
  for (const FrameStatistics& frame : frames) surfaces.insert(frame.surface);
  return surfaces.size();
}

namespace workload_csv {
struct Row {
  const Workload& workload;
  const WorkloadResults& results;
};
/// Mean over the measured frames; empty without any.
template <auto metric>
constexpr CsvColumn<Row> mean_column(std::string_view name) {
  return {name, [](const Row& row, std::string& out) {
            MeanOverFrames sum;
            for (const FrameStatistics& frame : row.results.frames)
              if (!frame.warmup) sum.add(static_cast<double>(frame.metrics.*metric));
            if (const auto mean = sum.mean()) out += csv_number(*mean);
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
    TILEPRESS_CSV_FIGURE("frames", row.results.frames.size()),
    TILEPRESS_CSV_FIGURE("surfaces", count_surfaces(row.results.frames)),
    shape_column<[](const FrameStatistics& frame) { return frame.width; }>("width"),
    shape_column<[](const FrameStatistics& frame) { return frame.height; }>("height"),
    shape_column<[](const FrameStatistics& frame) { return traits(frame.format).name; }>("format"),
    mean_column<&FrameMetrics::unique_colors>("unique_colors"),
    mean_column<&FrameMetrics::entropy>("entropy"),
    mean_column<&FrameMetrics::pixel_change>("pixel_change"),
    mean_column<&FrameMetrics::color_change>("color_change"),
    mean_column<&FrameMetrics::fvc_coverage>("fvc_coverage"),
    mean_column<&FrameMetrics::fvc_relative_coverage>("fvc_relative_coverage"),
    mean_column<&FrameMetrics::top100_coverage>("top100_coverage"),
};
}  // namespace workload_csv

std::vector<CsvColumn<FrameStatistics>> metric_columns() {
  std::vector<CsvColumn<FrameStatistics>> columns;
  for (const auto& column : frame_columns())
    if (!column.name.ends_with("_ns")) columns.push_back(column);
  return columns;
}

}  // namespace

std::string workloads_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = csv_header(workload_csv::kColumns);
  for (size_t i = 0; i < results.size(); ++i)
    append_csv_row(workload_csv::kColumns, workload_csv::Row{plan.workloads[i], results[i]}, out);
  return out;
}

std::string frame_metrics_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  const auto columns = metric_columns();
  std::string out = "workload,category," + csv_header(columns);
  for (size_t i = 0; i < results.size(); ++i)
    for (const FrameStatistics& frame : results[i].frames)
      append_csv_row(columns, frame, out += subject_cells(plan.workloads[i]));
  return out;
}

std::string color_cdf_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "workload,category,colors,pixels_share\n";
  for (size_t i = 0; i < results.size(); ++i) {
    std::istringstream lines(results[i].colors);
    std::string line;
    std::getline(lines, line);  // the header
    while (std::getline(lines, line)) out += subject_cells(plan.workloads[i]) + line + "\n";
  }
  return out;
}

std::string frame_rates_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "workload,category,frame,surface,configuration,rate,rate_payload,fvc_coverage\n";
  for (size_t i = 0; i < results.size(); ++i)
    for (const auto& sums : results[i].sums)
      for (const ResultFrame& frame : sums ? sums->each : std::vector<ResultFrame>()) {
        append_csv(out += subject_cells(plan.workloads[i]), frame.frame);
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
