// Sections: the parts of the page that are about all runs.
#pragma once

#include <vector>

#include "page_parts.h"

namespace tilepress {

/// All sections, in the page's order.
std::vector<Section> page_sections(const Batch& batch);

// The sections one by one. A section without a heading has nothing to show.

Section workloads_section(const Batch& batch);
/// Rates of `schemes` per workload: `rate` if with_bursts, else `rate_payload`.
Section rates_section(const Batch& batch, const std::vector<std::string>& schemes, bool with_bursts);
Section coverage_section(const Batch& batch);
/// CSV columns of a scheme's own, one section per scheme.
std::vector<Section> own_column_sections(const Batch& batch);
Section means_section(const Batch& batch, bool with_bursts);
/// Schemes whose further traffic is not in their rate.
Section extra_section(const Batch& batch);
Section energy_section(const Batch& batch);
/// The paper's means and the batch's own.
Section published_section(const Batch& batch);

}  // namespace tilepress
