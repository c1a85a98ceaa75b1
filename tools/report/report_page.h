// Report page: one HTML file that needs nothing but a browser.
#pragma once

#include <map>
#include <string>

#include "page_parts.h"

namespace tilepress {

/// A page in the template, with its style and script. `slots`: HTML of title, lead, markers, nav, sections,
/// series and footer, and the version.
std::string page_html(std::map<std::string, std::string, std::less<>> slots);

/// The page of an arranged batch.
std::string report_page(const Batch& batch, const std::string& title);

}  // namespace tilepress
