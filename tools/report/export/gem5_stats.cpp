// gem5 statistics: column widths as gem5's own text output has them.
#include "report/export/gem5_stats.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "report/html_text.h"
#include "report/scheme_names.h"

namespace tilepress {
namespace {

constexpr const char* kBegin = "\n---------- Begin Simulation Statistics ----------\n";
constexpr const char* kEnd = "\n---------- End Simulation Statistics   ----------\n";

/// "vdcp_blocks" as "vdcpBlocks".
std::string camel_case(std::string_view column) {
  std::string out;
  for (size_t i = 0; i < column.size(); ++i) {
    const bool upper = i > 0 && column[i - 1] == '_' && column[i] >= 'a' && column[i] <= 'z';
    if (column[i] != '_') out += upper ? static_cast<char>(column[i] - 'a' + 'A') : column[i];
  }
  return out;
}

/// Lines of one dump.
class Dump {
 public:
  explicit Dump(const std::string& prefix) : prefix_(prefix), text_(kBegin) {}
  void count(const std::string& name, uint64_t value, const char* description, const char* unit) {
    line(name, std::to_string(value), description, unit);
  }
  void real(const std::string& name, double value, const char* description, const char* unit) {
    line(name, std::isnan(value) ? "nan" : fmt::format("{:.6f}", value), description, unit);
  }
  void scheme(const std::string& scheme, const SchemeStatistics& sizes) {
    const std::string group = gem5_name(scheme) + ".";
    count(group + "blocks", sizes.blocks, "Number of 8x8 blocks", "Count");
    count(group + "rawBits", sizes.raw_bits, "Size of the frames, not compressed", "Bit");
    count(group + "payloadBits", sizes.payload_bits, "Payload of all blocks", "Bit");
    count(group + "bursts", sizes.bursts, "DRAM bursts that carry the payload", "Count");
    count(group + "csbBits", sizes.csb_bits, "Compression status bits", "Bit");
    count(group + "paletteBits", sizes.palette_bits, "Palettes and code tables", "Bit");
    count(group + "movedBits", sizes.moved_bits(), "All bits moved to DRAM", "Bit");
    real(group + "ratePayload", sizes.raw_bits > 0 ? sizes.rate_payload() : NAN,
         "Compression rate without bursts", "Ratio");
    real(group + "rate", sizes.raw_bits > 0 ? sizes.rate() : NAN, "Compression rate: rawBits / movedBits",
         "Ratio");
    const SchemeInfo* info = scheme_info(scheme);
    if (info == nullptr || sizes.own == OwnCounts{}) return;
    for (size_t i = 0; const char* column : info->own_columns())
      count(group + camel_case(column), sizes.own[i++],
            fmt::format("Column {} of schemes.csv", column).c_str(), "Count");
  }
  std::string end() const { return text_ + kEnd; }

 private:
  void line(const std::string& name, const std::string& value, const char* description, const char* unit) {
    fmt::format_to(std::back_inserter(text_), "{:<40} {:>20}                       # {} ({})\n",
                   prefix_ + "." + name, value, description, unit);
  }
  std::string prefix_, text_;
};

std::string frame_dump(const RunRecord& run, const std::string& prefix, const FrameStatistics& frame) {
  Dump dump(prefix);
  const FrameMetrics& metrics = frame.metrics;
  dump.count("frame", frame.frame, "Number of the frame in its surface", "Count");
  dump.count("surface", frame.surface, "Number of the surface", "Count");
  dump.count("width", frame.width, "Width in pixels", "Count");
  dump.count("height", frame.height, "Height in pixels", "Count");
  dump.real("presentSeconds", static_cast<double>(frame.time_ns) * 1e-9,
            "When the frame was presented, since the run began", "Second");
  dump.count("uniqueColors", metrics.unique_colors, "Different colours in the frame", "Count");
  dump.real("entropy", metrics.entropy, "Shannon entropy of the colours, bits per pixel", "Bit");
  dump.real("pixelChange", metrics.pixel_change, "Share of pixels that differ from the frame before",
            "Ratio");
  dump.real("colorChange", metrics.color_change, "Share of colours that differ from the frame before",
            "Ratio");
  dump.real("fvcCoverage", metrics.fvc_coverage, "Share of pixels counted in the default FVC", "Ratio");
  for (size_t i = 0; i < run.scheme_names.size() && i < frame.schemes.size(); ++i)
    dump.scheme(run.scheme_names[i], frame.schemes[i]);
  return dump.end();
}

}  // namespace

std::string gem5_name(const std::string& text) {
  return file_slug(text, "");
}

std::string gem5_stats(const RunRecord& run, const std::string& prefix, bool per_frame) {
  std::string out;
  if (per_frame) {
    for (const FrameStatistics& frame : run.frames)
      if (!frame.warmup) out += frame_dump(run, prefix, frame);
    return out;
  }
  Dump dump(prefix);
  dump.count("frames", run.frames.size(), "Frames captured", "Count");
  dump.count("measuredFrames", run.measured_frames, "Frames that are not warm-up; the sums count these",
             "Count");
  for (size_t i = 0; i < run.scheme_names.size(); ++i) dump.scheme(run.scheme_names[i], run.totals[i]);
  return dump.end();
}

}  // namespace tilepress
