// Workload options: one line of text each.
#include "workload_options.h"

namespace tilepress {

static std::string fault_of(const std::string& text) {
  for (const char letter : text)
    if (static_cast<unsigned char>(letter) < ' ') return "must be one line of text";
  return text.empty() ? "must not be empty" : "";
}

std::vector<std::pair<std::string, std::string>> WorkloadLabel::members() const {
  std::vector<std::pair<std::string, std::string>> out;
  if (!name.empty()) out.emplace_back("name", name);
  if (!category.empty()) out.emplace_back("category", category);
  return out;
}

void add_workload_options(CLI::App& app, WorkloadLabel& label) {
  app.add_option("--name", label.name, "Name of the workload in reports (default: that of the run's folder)")
      ->type_name("NAME")
      ->check(fault_of);
  app.add_option("--category", label.category, "Category of the workload in reports, such as UI, 2D or 3D")
      ->type_name("NAME")
      ->check(fault_of);
}

}  // namespace tilepress
