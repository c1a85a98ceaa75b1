// Read options: the CSB cache and rectangles.
#include "frames/read_options.h"

#include "frames/number_list.h"

namespace tilepress {

void add_read_options(CLI::App& app, ReadOptions& options) {
  app.add_option("--csb-lines", options.csb_lines,
                 "Lines of the CSB cache, 0 = none (default: " + std::to_string(options.csb_lines) + ")")
      ->type_name("N")
      ->check(CLI::Range(0, 65536));
  app.add_option("--csb-line-bursts", options.csb_line_bursts,
                 "Bursts in a line of the CSB cache (default: " + std::to_string(options.csb_line_bursts) + ")")
      ->type_name("N")
      ->check(CLI::Range(1, 65536));
}

std::optional<PixelRect> parse_rect(const std::string& text) {
  const auto values = parse_numbers<uint32_t, 4>(text, ',');
  if (!values || (*values)[2] == 0 || (*values)[3] == 0) return std::nullopt;
  return PixelRect{(*values)[0], (*values)[1], (*values)[2], (*values)[3]};
}

}  // namespace tilepress
