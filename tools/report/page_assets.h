// Page assets: the files of the report page, embedded at build time so that the tool needs no folder at run
// time.
#pragma once

#include <string_view>

namespace tilepress {

extern const std::string_view kPageTemplate;  ///< page/page.html, with {{slots}}
extern const std::string_view kPageStyle;     ///< page/page.css
extern const std::string_view kPageScript;    ///< page/page.js
extern const std::string_view kUplotScript;   ///< vendor/uplot/uPlot.iife.min.js
extern const std::string_view kUplotStyle;    ///< vendor/uplot/uPlot.min.css
extern const std::string_view kUplotLicence;  ///< vendor/uplot/LICENSE

}  // namespace tilepress
