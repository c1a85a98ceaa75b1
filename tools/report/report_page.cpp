// Report page: puts sections, series and assets into the template.
#include "report_page.h"

#include <fmt/format.h>

#include "counted.h"
#include "scheme_names.h"
#include "sections.h"

namespace tilepress {

// The files of the page, embedded at build time.
extern const std::string_view kPageTemplate, kPageStyle, kPageScript, kUplotScript, kUplotStyle,
    kUplotLicence;

namespace {

std::string series_json(const Batch& batch) {
  std::string out = "[";
  for (const RunSummary& run : batch.runs)
    out += fmt::format("{}\n{{\"name\":\"{}\",\"surfaces\":{}}}", out.size() > 1 ? "," : "",
                       escape_json(run.name), surfaces_json(run.surfaces));
  return out + "]";
}

std::string lead_text(const Batch& batch) {
  uint64_t frames = 0, measured = 0;
  for (const RunSummary& run : batch.runs) {
    frames += run.frames;
    measured += run.measured;
  }
  return fmt::format(
      "{}, {}, {} of them measured, {}. Framebuffer compression of captured frames in 8×8 blocks. Rate = raw "
      "bits / moved bits; higher is better.",
      counted(batch.runs.size(), "run"), counted(frames, "frame"), measured,
      counted(batch.schemes.size(), "scheme"));
}

}  // namespace

std::vector<Section> page_sections(const Batch& batch) {
  std::vector<std::string> dcp_family;
  for (const std::string& scheme : batch.schemes)
    if (scheme_family(scheme) == "dcp") dcp_family.push_back(scheme);
  // The means come first after the workloads: most readers look for them.
  std::vector<Section> out = {workloads_section(batch),
                              means_section(batch, true),
                              means_section(batch, false),
                              extra_section(batch),
                              energy_section(batch),
                              published_section(batch),
                              rates_section(batch, batch.schemes, true)};
  if (!dcp_family.empty()) out.push_back(rates_section(batch, dcp_family, false));
  out.push_back(coverage_section(batch));
  for (Section& section : own_column_sections(batch)) out.push_back(std::move(section));
  std::erase_if(out, [](const Section& section) { return section.heading.empty(); });
  return out;
}

std::string page_html(std::map<std::string, std::string, std::less<>> slots) {
  slots["uplot_style"] = kUplotStyle;
  slots["uplot_script"] = kUplotScript;
  slots["uplot_licence"] = kUplotLicence;
  slots["style"] = kPageStyle;
  slots["script"] = kPageScript;
  std::string& footer = slots["footer"];
  footer = "<p>" + footer + " The line charts use uPlot 1.6.32 (MIT licence, text in the page's source).</p>";
  return fill_slots(kPageTemplate, slots);
}

std::string report_page(const Batch& batch, const std::string& title) {
  std::string nav, sections;
  const auto add_runs = [&] {
    nav += section_link("runs", "Run by run");
    sections += run_parts(batch);
  };
  // The frames come first on the page of a single run, the comparison on the page of a batch.
  const bool single = batch.runs.size() == 1;
  const std::vector<Section> all = page_sections(batch);
  for (const Section& section : all) {
    nav += section_link(section.table.name, section.heading);
    sections += section_html(section);
    if (single && &section == &all.front()) add_runs();
  }
  if (!single) add_runs();
  return page_html(
      {{"version", TILEPRESS_VERSION},
       {"title", escape_html(title)},
       {"lead", escape_html(lead_text(batch))},
       {"markers", marker_definitions() + "<linearGradient id=\"heat-scale\">" + heat_scale_stops() +
                       "</linearGradient>"},
       {"nav", nav},
       {"sections", sections},
       {"series", series_json(batch)},
       {"footer",
        "Made by tilepress " TILEPRESS_VERSION
        " from frames.csv, schemes.csv and run.json of the runs above. Each value in a table is a cell of "
        "those files, a sum of such cells, or follows from them by the formula beside it. The CSV downloads "
        "have full precision."}});
}

}  // namespace tilepress
