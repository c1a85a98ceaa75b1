// Run JSON: members are in the order of this file.
#include "run/run_json.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tilepress/cost_model.h"
#include "tilepress/run_option_table.h"
#include "tilepress/utc_time.h"

namespace tilepress {
namespace {

using Json = nlohmann::ordered_json;

Json host_json() {
  utsname system{};
  uname(&system);
  return {{"name", system.nodename},
          {"system", std::string(system.sysname) + " " + system.release},
          {"machine", system.machine},
          {"cpus", sysconf(_SC_NPROCESSORS_ONLN)}};
}

constexpr std::pair<const char*, uint64_t RunCounts::*> kCounts[] = {
    {"seen", &RunCounts::seen},
    {"captured", &RunCounts::captured},
    {"dropped", &RunCounts::dropped},
    {"skipped", &RunCounts::skipped},
    {"unsupported", &RunCounts::unsupported},
    {"not_captured", &RunCounts::not_captured}};

constexpr std::pair<const char*, std::string RunInfo::*> kTexts[] = {{"via", &RunInfo::via},
                                                                     {"api", &RunInfo::api},
                                                                     {"gl_vendor", &RunInfo::gl_vendor},
                                                                     {"gl_renderer", &RunInfo::gl_renderer},
                                                                     {"gl_version", &RunInfo::gl_version}};

Json counts_json(const RunCounts& counts) {
  Json out = Json::object();
  for (const auto& [name, member] : kCounts) out[name] = counts.*member;
  return out;
}

Json option_json(const RunOption& option, const std::string& value) {
  switch (option.json.form) {
    case JsonForm::kNumber:
      return Json::parse(value);
    case JsonForm::kBoolean:
      return value == "1";
    case JsonForm::kList: {
      Json list = Json::array();
      std::istringstream words(value);
      for (std::string word; words >> word;) list.push_back(word);
      return list;
    }
    default:
      return value;
  }
}

Json options_json(const RunOptions& options) {
  Json out = Json::object();
  for (const RunOption& option : run_option_table())
    if (option.json.form != JsonForm::kAbsent)
      out[std::string(option.json.key)] = option_json(option, option.text.print(options));
  return out;
}

/// The constants behind the powers of totals_json().
Json energy_json() {
  const CostConstants constants;
  const SurfaceLoad load;
  return {{"dram_pj_per_byte", constants.dram_pj_per_byte},
          {"structures_pj_per_byte", constants.structures_pj_per_byte},
          {"refresh_hz", load.refresh_hz},
          {"passes", load.passes}};
}

/// Bytes per second that the average measured frame moves without compression, written and read.
double raw_bytes_per_s(const SchemeStatistics& sum, uint64_t measured_frames) {
  const SurfaceLoad load;
  const double frame_bytes = static_cast<double>(sum.raw_bits) / 8 / static_cast<double>(measured_frames);
  return frame_bytes * load.refresh_hz * load.passes;
}

Json totals_json(const std::vector<std::string>& names, const std::vector<SchemeStatistics>& totals,
                 uint64_t measured_frames) {
  Json list = Json::array();
  for (size_t i = 0; i < names.size() && i < totals.size(); ++i) {
    const SchemeStatistics& sum = totals[i];
    Json entry = {{"scheme", names[i]},
                  {"blocks", sum.blocks},
                  {"raw_bits", sum.raw_bits},
                  {"payload_bits", sum.payload_bits},
                  {"bursts", sum.bursts},
                  {"csb_bits", sum.csb_bits},
                  {"palette_bits", sum.palette_bits},
                  {"moved_bits", sum.moved_bits()}};
    // A run without measured frames has no rate, and JSON has no NaN.
    entry["rate_payload"] = sum.raw_bits > 0 ? Json(sum.rate_payload()) : Json(nullptr);
    entry["rate"] = sum.raw_bits > 0 ? Json(sum.rate()) : Json(nullptr);
    if (sum.rate() > 0 && measured_frames > 0) {
      const double raw_rate = raw_bytes_per_s(sum, measured_frames);
      entry["energy_saving"] = energy_saving(sum.rate());
      entry["power_mw"] = compressed_power_mw(raw_rate, sum.rate());
      entry["raw_power_mw"] = dram_power_mw(raw_rate);
    }
    if (sum.checked_blocks > 0) {
      entry["checked_blocks"] = sum.checked_blocks;
      entry["mismatched_blocks"] = sum.mismatched_blocks;
    }
    if (sum.toggles) {
      entry["toggles"] = sum.toggles->plain;
      entry["toggles_dbi"] = sum.toggles->inverted;
      entry["raw_toggles"] = sum.toggles->raw_plain;
      entry["raw_toggles_dbi"] = sum.toggles->raw_inverted;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

/// `targets`: also the figures of images of framebuffer objects, apart from what is presented.
void put_figures(const RunRecord& record, bool targets, Json& json) {
  json["counts"] = counts_json(record.counts);
  json["measured_frames"] = record.measured_frames;
  json["energy"] = energy_json();
  json["schemes"] = totals_json(record.scheme_names, record.totals, record.measured_frames);
  if (targets)
    json["targets"] = {
        {"counts", counts_json(record.target_counts)},
        {"measured_frames", record.measured_targets},
        {"schemes", totals_json(record.scheme_names, record.target_totals, record.measured_targets)}};
}

std::string dump(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <typename T>
void take(const Json& object, const char* name, T& out) {
  const auto member = object.find(name);
  if (member == object.end()) return;
  try {
    out = member->get<T>();
  } catch (const Json::exception&) {
    // A member of another type is none that this version knows.
  }
}

void take_counts(const Json& owner, RunCounts& out) {
  const auto counts = owner.find("counts");
  if (counts == owner.end() || !counts->is_object()) return;
  for (const auto& [name, member] : kCounts) take(*counts, name, out.*member);
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string run_json_text(const RunRecord& record, const RunOptions& options) {
  const RunInfo& info = record.info;
  Json json = {{"schema_version", kRunSchemaVersion},
               {"tilepress_version", TILEPRESS_VERSION},
               {"state", record.state},
               {"reason", record.reason},
               {"started", record.started},
               {"command", info.command},
               {"program", info.program},
               {"pid", info.pid}};
  for (const auto& [name, member] : kTexts) json[name] = info.*member;
  for (const auto& [name, value] : info.further) json[name] = value;
  json["host"] = host_json();
  json["options"] = options_json(options);
  put_figures(record, options.all_targets, json);
  return dump(json);
}

Result<void> read_run_json(std::string_view text, RunRecord& record) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::kFile, "not a JSON object"};
  take(json, "state", record.state);
  take(json, "reason", record.reason);
  take(json, "started", record.started);
  RunInfo& info = record.info;
  take(json, "command", info.command);
  take(json, "program", info.program);
  take(json, "pid", info.pid);
  for (const auto& [name, member] : kTexts) take(json, name, info.*member);
  const auto known = [](const std::string& name) {
    for (const char* other : {"state", "reason", "started", "program", "tilepress_version"})
      if (name == other) return true;
    return std::ranges::any_of(kTexts, [&](const auto& member) { return name == member.first; });
  };
  for (const auto& [name, value] : json.items())
    if (value.is_string() && !known(name)) info.further.emplace_back(name, value.get<std::string>());
  take_counts(json, record.counts);
  if (const auto targets = json.find("targets"); targets != json.end() && targets->is_object())
    take_counts(*targets, record.target_counts);
  if (const auto options = json.find("options"); options != json.end() && options->is_object()) {
    take(*options, "schemes", record.scheme_names);
    take(*options, "burst", record.burst_bits);
  }
  return {};
}

std::string finished_run_json(std::string_view text, const RunRecord& record, const RunEnd& end) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    json = {{"schema_version", kRunSchemaVersion},
            {"tilepress_version", TILEPRESS_VERSION},
            {"program", record.info.program}};
  json["state"] = record.state;
  json["reason"] = record.reason;
  if (!end.program.empty()) json["program"] = end.program;
  if (!end.via.empty()) json["via"] = end.via;
  for (const auto& [name, value] : end.further) json[name] = value;
  for (const auto& [name, value] : end.figures) json[name] = value;
  if (end.exit_status) json["exit_status"] = *end.exit_status;
  if (end.signal) json["signal"] = *end.signal;
  json["ended"] = utc_now();
  put_figures(record, record.target_counts.seen > 0 || json.contains("targets"), json);
  return dump(json);
}

}  // namespace tilepress
