// Run parts: facts, totals and line charts of each run.
#include <fmt/format.h>

#include "counted.h"
#include "page_parts.h"

namespace tilepress {
namespace {

Table totals_table(const RunSummary& run, size_t index) {
  Table table{
      .name = fmt::format("run-{}", index),
      .caption = fmt::format("Sums over {}, without warm-up frames", counted(run.measured, "measured frame")),
      .header = {"scheme", "blocks", "raw_bits", "payload_bits", "bursts", "csb_bits", "palette_bits",
                 "rate_payload", "rate"}};
  for (size_t i = 0; i < run.schemes.size(); ++i) {
    const SchemeStatistics& sum = run.totals[i];
    table.rows.push_back({text_cell(run.schemes[i]), count_cell(sum.blocks), count_cell(sum.raw_bits),
                          count_cell(sum.payload_bits), count_cell(sum.bursts), count_cell(sum.csb_bits),
                          count_cell(sum.palette_bits), number_cell(run.rate_payload(run.schemes[i])),
                          number_cell(run.rate(run.schemes[i]))});
  }
  return table;
}

std::string pictures_html(const RunSummary& run) {
  if (run.pictures.empty()) return "";
  std::string out =
      "<h3>Frames and bits per block</h3>\n<p class=\"note\">A cell is an 8×8 block: <svg class=\"scale\" "
      "role=\"img\" "
      "aria-label=\"colour scale from dark, 0 bits, to yellow, not compressed\"><rect width=\"100%\" "
      "height=\"100%\" fill=\"url(#heat-scale)\"/></svg> 0 bits "
      "to not compressed. "
      "The page shrinks the pictures. The run's folders frames and heatmaps have them in full size.</p>\n<div "
      "class=\"pictures\">\n";
  for (const RunPicture& picture : run.pictures) {
    out += fmt::format("<figure><figcaption>frame {}, surface {}</figcaption><div class=\"row\">",
                       picture.frame, picture.surface);
    if (!picture.thumbnail.empty())
      out += fmt::format(
          "<div class=\"shot\"><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"frame {}\">frame</div>",
          picture.thumbnail, picture.width, picture.height, picture.frame);
    for (const HeatMap& map : picture.heat_maps)
      out += fmt::format(
          "<div class=\"shot\"><img class=\"heat\" src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}: {:.1f} of "
          "{} bits per block on average, {} at most\">{}</div>",
          map.image, picture.width, picture.height, escape_html(map.scheme), map.mean_bits, map.raw_bits,
          map.most_bits, escape_html(map.scheme));
    out += "</div></figure>\n";
  }
  return out + "</div>\n";
}

}  // namespace

std::string run_parts(const Batch& batch) {
  std::string out = "<section id=\"runs\">\n<h2>Run by run</h2>\n";
  if (batch.runs.size() > 1) {
    out += "<label class=\"pick\">Run <select id=\"run-pick\">";
    for (size_t i = 0; i < batch.runs.size(); ++i)
      out += fmt::format("<option value=\"{}\">{}</option>", i, escape_html(batch.runs[i].name));
    out += "</select></label>\n";
  }
  out +=
      "<noscript><p class=\"warn\">The line charts need JavaScript. All other parts of this page work without "
      "it.</p></noscript>\n";
  for (size_t i = 0; i < batch.runs.size(); ++i) {
    const RunSummary& run = batch.runs[i];
    out += fmt::format("<section class=\"run\" id=\"run-{}\">\n<h3>{}</h3>\n<dl class=\"facts\">\n", i,
                       escape_html(run.name));
    for (const auto& [name, value] : run.facts)
      out += "<dt>" + escape_html(name) + "</dt><dd>" + escape_html(value) + "</dd>\n";
    out += "</dl>\n";
    const Table table = totals_table(run, i);
    out += table_html(table) + "<div class=\"tools\">" +
           csv_button(table.name, file_slug(run.name) + "-totals.csv") + "</div>\n";
    if (run.measured == 0)
      out += "<p class=\"warn\">This run has no measured frame and no chart.</p>\n";
    out += "<div class=\"line-charts\"></div>\n" + pictures_html(run) + "</section>\n";
  }
  return out + "</section>\n";
}

}  // namespace tilepress
