// Study outputs: from the study's data to its files.
#include <filesystem>

#include "streams/output_file.h"
#include "study/figures/claims.h"
#include "study/figures/document_table.h"
#include "study/figures/figure.h"
#include "study/figures/study_outputs.h"
#include "study/figures/study_page.h"
#include "study/figures/study_tables.h"

namespace tilepress {
namespace {

/// Writes files below one folder and keeps the first error.
class OutputFolder {
 public:
  explicit OutputFolder(std::string path) : path_(std::move(path)) {}
  void write(const std::string& name, const std::string& text) {
    if (!state_) return;
    const std::string path = path_ + "/" + name;
    std::error_code code;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), code);
    state_ = write_whole_file(path, text, true);
  }
  const Result<void>& state() const { return state_; }

 private:
  std::string path_;
  Result<void> state_;
};

void write_table(OutputFolder& folder, const Table& table, const std::string& stem) {
  folder.write(stem + ".md", table_markdown(table));
  folder.write(stem + ".tex", table_latex(table));
  folder.write(stem + ".html", table_page(table));
}

std::vector<Figure> make_figures(const StudyData& data, std::vector<std::string>& lines) {
  std::vector<Figure> figures;
  if (data.ordered_workloads().empty()) {
    lines.emplace_back("no workload has results: there are no figures");
    return figures;
  }
  for (const FigureSpec& spec : figure_specs(data)) {
    auto figure = make_figure(data, spec);
    if (figure)
      figures.push_back(std::move(*figure));
    else
      lines.push_back(figure.error().text);
  }
  return figures;
}

/// The figures that have both drawings.
std::vector<std::string> drawn_figures(const std::string& study_folder, const std::vector<Figure>& figures) {
  std::vector<std::string> names;
  for (const Figure& figure : figures) {
    const std::string stem = study_folder + "/figures/" + figure.spec.name;
    if (std::filesystem::exists(stem + ".svg") && std::filesystem::exists(stem + ".pdf"))
      names.push_back(figure.spec.name);
  }
  return names;
}

}  // namespace

Result<std::vector<std::string>> write_study_data(const std::string& study_folder, FigureDrawing draw) {
  const auto data = read_study_data(study_folder);
  if (!data) return data.error();
  std::vector<std::string> lines;
  const std::vector<Figure> figures = make_figures(*data, lines);
  OutputFolder folder(study_folder);
  for (const Figure& figure : figures)
    folder.write("figures/" + figure.spec.name + ".csv", figure.table.csv());
  folder.write("figures/figures.json", figures_json(*data, figures));
  const std::vector<Table> tables = study_tables(*data);
  for (const Table& table : tables) write_table(folder, table, "tables/" + table.name);
  const std::vector<Claim> claims = make_claims(*data);
  folder.write("claims.csv", claims_csv(claims));
  write_table(folder, claims_table(claims), "claims");
  if (!folder.state()) return folder.state().error();
  if (draw != nullptr) {
    const auto drawn = draw(study_folder);
    if (!drawn) return drawn.error();
    lines.insert(lines.end(), drawn->begin(), drawn->end());
  }
  folder.write("study.html",
               study_page(*data, claims, figures, tables, drawn_figures(study_folder, figures)));
  if (!folder.state()) return folder.state().error();
  return lines;
}

}  // namespace tilepress
