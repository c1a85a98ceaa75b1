// Sections: their order on the page.
#include "sections.h"

#include "scheme_names.h"

namespace tilepress {

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

}  // namespace tilepress
