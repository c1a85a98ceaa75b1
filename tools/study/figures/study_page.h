// Study page: study.html, one page that tells a study. It needs nothing but a browser.
#pragma once

#include <string>
#include <vector>

#include "report/page_parts.h"
#include "study/figures/claims.h"
#include "study/figures/figure.h"

namespace tilepress {

/// The claims as dots of the study and of the paper, and as a table.
Section claims_section(const std::vector<Claim>& claims);

/// The page: claims, figures, workloads, tables. `drawn` names the figures that have NAME.svg and NAME.pdf.
std::string study_page(const StudyData& data, const std::vector<Claim>& claims,
                       const std::vector<Figure>& figures, const std::vector<Table>& tables,
                       const std::vector<std::string>& drawn);

}  // namespace tilepress
