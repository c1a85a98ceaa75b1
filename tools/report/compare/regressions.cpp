// Regressions: one list of checks, three ways to write it.
#include "report/compare/regressions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "counted.h"
#include "html_text.h"

namespace tilepress {
namespace {

std::string fault_of(const SchemeComparison& scheme, double threshold_percent) {
  const double change = relative_change(scheme.a.rate(), scheme.b.rate());
  if (std::isnan(change) || change * 100 >= -threshold_percent) return {};
  return fmt::format("rate of {} fell by {:.3g} % ({:.6g} to {:.6g}), more than {:g} %", scheme.scheme,
                     -change * 100, scheme.a.rate(), scheme.b.rate(), threshold_percent);
}

size_t failures_in(const std::vector<RateCheck>& checks) {
  return static_cast<size_t>(
      std::count_if(checks.begin(), checks.end(), [](const auto& one) { return !one.fault.empty(); }));
}

/// Text of a workflow command. Those of a property also escape ':' and ','.
std::string command_text(const std::string& text, bool property) {
  std::string out;
  for (const char letter : text) {
    const bool special =
        letter == '%' || letter == '\r' || letter == '\n' || (property && (letter == ':' || letter == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned>(letter)) : std::string(1, letter);
  }
  return out;
}

}  // namespace

std::vector<RateCheck> check_rates(const std::vector<RunComparison>& runs,
                                   const std::vector<std::string>& unpaired, double threshold_percent) {
  std::vector<RateCheck> checks;
  for (const std::string& line : unpaired) checks.push_back({"runs", line.substr(0, line.find(": ")), line});
  for (const RunComparison& run : runs) {
    for (const SchemeComparison& scheme : run.schemes)
      checks.push_back({run.name, scheme.scheme, fault_of(scheme, threshold_percent)});
    for (const std::string& scheme : run.schemes_only_a)
      checks.push_back({run.name, scheme, "B has no rows of " + scheme});
    if (run.common == 0) checks.push_back({run.name, "frames", "no frame in common"});
  }
  return checks;
}

std::string junit_xml(const std::vector<RateCheck>& checks) {
  std::map<std::string, std::vector<RateCheck>> suites;
  for (const RateCheck& check : checks) suites[check.workload].push_back(check);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tilepress compare\" tests=\"{}\" "
      "failures=\"{}\">\n",
      checks.size(), failures_in(checks));
  for (const auto& [name, cases] : suites) {
    out += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", escape_html(name),
                       cases.size(), failures_in(cases));
    for (const RateCheck& one : cases) {
      out += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escape_html(name),
                         escape_html(one.subject));
      out += one.fault.empty()
                 ? "/>\n"
                 : fmt::format("><failure message=\"{}\"/></testcase>\n", escape_html(one.fault));
    }
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

std::string github_annotations(const std::vector<RateCheck>& checks,
                               const std::vector<std::string>& remarks) {
  std::string out;
  for (const std::string& remark : remarks)
    out += "::warning title=tilepress compare::" + command_text(remark, false) + "\n";
  for (const RateCheck& check : checks)
    if (!check.fault.empty())
      out += fmt::format("::error title={}::{}\n", command_text("tilepress compare " + check.workload, true),
                         command_text(check.fault, false));
  if (failures_in(checks) == 0)
    out += "::notice title=tilepress compare::" + counted(checks.size(), "rate") + " compared, none fell\n";
  return out;
}

}  // namespace tilepress
