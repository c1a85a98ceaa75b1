// Present costs: sums of columns, found by name because runs of older versions have fewer.
#include "capture/present_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

#include "tilepress/csv_reader.h"

namespace tilepress {

PresentCosts present_costs(const RunRecord& run) {
  PresentCosts costs;
  std::ifstream file(run.path + "/presents.csv");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  CsvReader reader(text);
  std::vector<std::string> names, row;
  if (!reader.next(names)) return costs;
  const std::pair<const char*, double*> columns[] = {{"readback_ns", &costs.readback_ns},
                                                     {"read_ns", &costs.read_ns},
                                                     {"bind_ns", &costs.bind_ns},
                                                     {"hand_off_ns", &costs.hand_off_ns},
                                                     {"wait_ns", &costs.wait_ns}};
  while (reader.next(row)) {
    if (row.size() < names.size() || row[0] == "0") continue;  // frame 0 pays for the start of it all
    ++costs.frames;
    for (const auto& [name, sum] : columns) {
      const auto at = std::find(names.begin(), names.end(), name);
      if (at != names.end())
        *sum += std::strtod(row[static_cast<size_t>(at - names.begin())].c_str(), nullptr);
    }
  }
  if (costs.frames == 0) return costs;
  for (const auto& [name, sum] : columns) *sum /= static_cast<double>(costs.frames);
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
