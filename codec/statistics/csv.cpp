// CSV rows of frames.csv and schemes.csv (spec §10).
#include <charconv>

#include "tilepress/scheme.h"
#include "tilepress/statistics.h"

namespace tilepress {
namespace {

void add(std::string& out, uint64_t value) {
  char buffer[24];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  out.append(buffer, end);
  out += ',';
}
void add(std::string& out, double value) {
  out += csv_number(value);
  out += ',';
}
void end_row(std::string& out) {
  out.back() = '\n';
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return std::string(buffer, end);
}

std::string frames_csv_header() {
  return "frame,surface,width,height,format,warmup,time_ns,unique_colors,entropy,pixel_change,color_change,"
         "fvc_coverage,fvc_relative_coverage,top100_coverage,readback_ns,encode_ns\n";
}

std::string schemes_csv_header() {
  std::string header =
      "frame,surface,scheme,warmup,blocks,raw_bits,payload_bits,bursts,csb_bits,palette_bits,rate_payload,"
      "rate,"
      "extra_bits,";
  for (const SchemeInfo& info : scheme_registry())
    for (const char* column : info.columns) header += std::string(column) + ',';
  return header + "checked_blocks,mismatched_blocks,rate_with_extra\n";
}

void append_frames_row(const FrameStatistics& frame, std::string& out) {
  const FrameMetrics& metrics = frame.metrics;
  add(out, frame.frame);
  add(out, uint64_t{frame.surface});
  add(out, uint64_t{frame.width});
  add(out, uint64_t{frame.height});
  out += traits(frame.format).name;
  out += ',';
  add(out, uint64_t{frame.warmup});
  add(out, frame.time_ns);
  add(out, metrics.unique_colors);
  add(out, metrics.entropy);
  add(out, metrics.pixel_change);
  add(out, metrics.color_change);
  add(out, metrics.fvc_coverage);
  add(out, metrics.fvc_relative_coverage);
  add(out, metrics.top100_coverage);
  add(out, frame.readback_ns);
  add(out, frame.encode_ns);
  end_row(out);
}

void append_schemes_rows(const FrameStatistics& frame, const std::vector<std::string>& scheme_names,
                         std::string& out) {
  for (size_t i = 0; i < frame.schemes.size(); ++i) {
    const SchemeStatistics& scheme = frame.schemes[i];
    add(out, frame.frame);
    add(out, uint64_t{frame.surface});
    out += csv_field(scheme_names[i]);
    out += ',';
    add(out, uint64_t{frame.warmup});
    add(out, scheme.blocks);
    add(out, scheme.raw_bits);
    add(out, scheme.payload_bits);
    add(out, scheme.bursts);
    add(out, scheme.csb_bits);
    add(out, scheme.palette_bits);
    add(out, scheme.rate_payload());
    add(out, scheme.rate());
    add(out, scheme.extra_bits);
    const std::string_view name = std::string_view(scheme_names[i]).substr(0, scheme_names[i].find(':'));
    for (const SchemeInfo& info : scheme_registry())
      for (size_t column = 0; column < info.columns.size(); ++column)
        add(out, name == info.name ? scheme.own[column] : 0);
    add(out, scheme.checked_blocks);
    add(out, scheme.mismatched_blocks);
    add(out, scheme.rate_with_extra());
    end_row(out);
  }
}

}  // namespace tilepress
