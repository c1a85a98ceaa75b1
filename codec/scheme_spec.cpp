// Scheme specifications: the grammar `name:key=value,key=value` and the range of each key.
#include "tilepress/scheme_spec.h"

#include <bit>
#include <charconv>

#include "palette/palette_file.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

bool parse_number(std::string_view text, uint32_t low, uint32_t high, uint32_t& out) {
  uint32_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || value < low || value > high) return false;
  out = value;
  return true;
}

bool parse_share(std::string_view text, double& out) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || !(value >= 0 && value <= 1)) return false;
  out = value;
  return true;
}

bool parse_policy(std::string_view text, FvcPolicy& out) {
  constexpr std::pair<std::string_view, FvcPolicy> kPolicies[] = {{"lfc", FvcPolicy::kLfc},
                                                                  {"2lfc", FvcPolicy::k2Lfc},
                                                                  {"lru", FvcPolicy::kLru},
                                                                  {"random", FvcPolicy::kRandom}};
  for (const auto& [name, policy] : kPolicies)
    if (text == name) {
      out = policy;
      return true;
    }
  return false;
}

constexpr uint32_t kLargest = 0x7FFFFFFF;

/// What values a key takes; empty if the scheme does not know the key. Where more is to be said about a bad
/// value, `reason` says it.
std::string_view set_key(SchemeSpec& spec, const SchemeInfo& info, std::string_view key,
                         std::string_view value, PaletteFiles files, bool& ok, std::string& reason) {
  if (info.takes_fvc_keys) {
    if (key == "fvc") {
      ok = parse_number(value, 2, 1024, spec.fvc.entries) && std::has_single_bit(spec.fvc.entries);
      return "a power of two from 2 to 1024";
    }
    if (key == "policy") return ok = parse_policy(value, spec.fvc.policy), "lfc, 2lfc, lru or random";
    if (key == "ways") return ok = parse_number(value, 1, 1024, spec.fvc.ways), "a divisor of the FVC size";
    if (key == "sample")
      return ok = parse_number(value, 1, kLargest, spec.fvc.sample), "a whole number from 1";
    if (key == "period")
      return ok = parse_number(value, 1, kLargest, spec.fvc.period), "a whole number from 1";
    if (key == "coverage") return ok = parse_share(value, spec.coverage), "a number from 0 to 1";
  }
  if (info.takes_ras_keys) {
    if (key == "ycocg") {
      ok = value == "0" || value == "1";
      spec.ycocg = value == "1";
      return "0 or 1";
    }
    if (key == "sizes") {
      ok = value == "2" || value == "3" || value == "burst";
      spec.ras_sizes = value == "2" ? RasSizes::kTwo : value == "burst" ? RasSizes::kBurst : RasSizes::kThree;
      return "2, 3 or burst";
    }
  }
  if (info.takes_entries_key && key == "entries") {
    ok = parse_number(value, 2, 1024, spec.entries) && std::has_single_bit(spec.entries);
    return "a power of two from 2 to 1024";
  }
  if (info.takes_palette_keys && key == "from") return ok = value == "first", "first";
  if (info.takes_palette_keys && key == "file") {
    ok = files == PaletteFiles::kLeave ? !value.empty()
                                       : read_palette_file(std::string(value), spec.palette, reason);
    return "the path of a file";
  }
  if (info.takes_order_key && key == "order") {
    ok = value == "raster" || value == "quad";
    spec.order = value == "quad" ? LineOrder::kQuad : LineOrder::kRaster;
    return "raster or quad";
  }
  return {};
}

}  // namespace

std::optional<SchemeSpec> parse_scheme(std::string_view text, std::string& error, PaletteFiles files) {
  SchemeSpec spec;
  spec.text = text;
  const size_t colon = text.find(':');
  spec.name = text.substr(0, colon);
  const SchemeInfo* info = find_scheme(spec.name);
  const auto fail = [&](std::string reason) {
    error = "scheme '" + spec.text + "': " + std::move(reason);
    return std::nullopt;
  };
  if (info == nullptr) {
    std::string known;
    for (const SchemeInfo& scheme : scheme_registry())
      known += std::string(known.empty() ? "" : ", ") + scheme.name;
    return fail("unknown scheme '" + spec.name + "' (there are " + known + ")");
  }
  std::string_view rest = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  if (colon != std::string_view::npos && rest.empty()) return fail("nothing after ':'");
  std::string seen = ",";
  while (!rest.empty()) {
    const size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    if (comma != std::string_view::npos && comma + 1 == rest.size())
      return fail("nothing after the last ','");
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
    const size_t equals = item.find('=');
    if (equals == std::string_view::npos) return fail("'" + std::string(item) + "' is not key=value");
    const std::string key(item.substr(0, equals)), value(item.substr(equals + 1));
    bool ok = false;
    std::string reason;
    const std::string_view allowed = set_key(spec, *info, key, value, files, ok, reason);
    if (allowed.empty()) return fail("unknown key '" + key + "'");
    if (!ok)
      return fail(key + "=" + value + ": " + (reason.empty() ? "must be " + std::string(allowed) : reason));
    if (seen.find("," + key + ",") != std::string::npos) return fail("key '" + key + "' given twice");
    seen += key + ",";
  }
  if (seen.find(",file,") != std::string::npos &&
      (seen.find(",from,") != std::string::npos || seen.find(",entries,") != std::string::npos))
    return fail("from and entries do not go with file");
  if (spec.fvc.ways != 0 && spec.fvc.entries % spec.fvc.ways != 0)
    return fail("ways=" + std::to_string(spec.fvc.ways) + ": must divide the FVC size " +
                std::to_string(spec.fvc.entries));
  if (spec.fvc.ways == spec.fvc.entries) spec.fvc.ways = 0;  // the same FVC: share it
  return spec;
}

std::vector<SchemeSpec> default_schemes() {
  std::vector<SchemeSpec> schemes;
  std::string error;
  for (const char* name : {"dcp", "adcp", "vdcp", "huffdcp", "ras", "red", "hdcp"})
    schemes.push_back(*parse_scheme(name, error));
  return schemes;
}

}  // namespace tilepress
