// Report page: one HTML file that needs nothing but a browser.
#pragma once

#include <string>

#include "page_parts.h"

namespace tilepress {

/// The page of an arranged batch.
std::string report_page(const Batch& batch, const std::string& title);

}  // namespace tilepress
