// Present costs: sums over the rows of presents.csv.
#include "capture/present_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "tilepress/csv_rows.h"
#include "tilepress/present_rows.h"

namespace tilepress {

PresentCosts present_costs(const RunRecord& run) {
  PresentCosts costs;
  std::ifstream file(run.path + "/presents.csv");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  CsvRecords records(text);
  const CsvRowReader<PresentRow> reader(records, present_columns());
  constexpr std::pair<uint64_t PresentRow::*, double PresentCosts::*> kSums[] = {
      {&PresentRow::readback_ns, &PresentCosts::readback_ns},
      {&PresentRow::read_ns, &PresentCosts::read_ns},
      {&PresentRow::bind_ns, &PresentCosts::bind_ns},
      {&PresentRow::hand_off_ns, &PresentCosts::hand_off_ns},
      {&PresentRow::wait_ns, &PresentCosts::wait_ns}};
  while (records.next()) {
    PresentRow row;
    if (!reader.read(row) || row.frame == 0) continue;  // frame 0 also pays for the start
    ++costs.frames;
    for (const auto& [part, sum] : kSums) costs.*sum += static_cast<double>(row.*part);
  }
  if (costs.frames == 0) return costs;
  for (const auto& [part, sum] : kSums) costs.*sum /= static_cast<double>(costs.frames);
  for (const FrameStatistics& frame : run.frames)
    if (!frame.warmup) costs.encode_ns += static_cast<double>(frame.encode_ns);
  costs.encode_ns /= static_cast<double>(std::max<uint64_t>(run.measured_frames, 1));
  return costs;
}

std::string present_costs_text(const PresentCosts& costs) {
  if (costs.frames == 0) return {};
  const auto ms = [](double ns) { return ns / 1e6; };
  return fmt::format(
      "  per frame: {:.2f} ms readback (read {:.2f}, making current {:.2f}), {:.3f} ms hand-off, {:.2f} ms "
      "waiting for the queue;\n             {:.2f} ms encoding on the worker's thread\n",
      ms(costs.readback_ns), ms(costs.read_ns), ms(costs.bind_ns), ms(costs.hand_off_ns), ms(costs.wait_ns),
      ms(costs.encode_ns));
}

}  // namespace tilepress
