// Run comparison: pairs frames by surface and number.
#include "report/compare/run_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/run_batch.h"
#include "study/configuration.h"
#include "tilepress/run_option_table.h"

namespace tilepress {
namespace {

using FrameKey = std::pair<uint32_t, uint64_t>;  // surface, frame

std::map<FrameKey, const FrameStatistics*> measured_frames(const RunRecord& run, const FrameSet& frames) {
  std::map<FrameKey, const FrameStatistics*> out;
  for (const FrameStatistics& frame : run.frames)
    if (!frame.warmup && frames.contains(frame.frame)) out[{frame.surface, frame.frame}] = &frame;
  return out;
}

bool same_picture(const FrameStatistics& a, const FrameStatistics& b) {
  return a.width == b.width && a.height == b.height && a.format == b.format &&
         a.metrics.unique_colors == b.metrics.unique_colors &&
         std::abs(a.metrics.entropy - b.metrics.entropy) < 1e-9;
}

/// The text of its configuration, or the name itself if this build has no such scheme.
std::string configuration_of(const std::string& name) {
  const auto spec = parse_scheme(name);
  return spec ? canonical_text(*spec) : name;
}

/// Names of `names` that `others` lacks.
std::vector<std::string> missing_from(const std::vector<std::string>& others,
                                      const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const std::string& name : names)
    if (scheme_position(others, name) == others.size()) out.push_back(name);
  return out;
}

std::string shown(const nlohmann::json& value) {
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  return text.empty() ? "none" : text;
}

/// "tile 32 in A, 64 in B" for each option that changes rows, that both run.json files name, and that
/// differs. The schemes are left out, and --verify, which changes no size.
std::vector<std::string> option_differences(const std::string& run_a, const std::string& run_b) {
  const auto a = run_document(run_a)["options"], b = run_document(run_b)["options"];
  std::vector<std::string> out;
  for (const RunOption& option : run_option_table()) {
    const std::string key(option.json.key);
    if (option.rows == RowsEffect::kNone || option.name == "scheme" || option.name == "verify") continue;
    if (!a.contains(key) || !b.contains(key) || a[key] == b[key]) continue;
    out.push_back(std::string(option.name) + " " + shown(a[key]) + " in A, " + shown(b[key]) + " in B");
  }
  return out;
}

}  // namespace

size_t scheme_position(const std::vector<std::string>& names, const std::string& scheme) {
  auto found = std::ranges::find(names, scheme);
  if (found == names.end()) found = std::ranges::find(names, configuration_of(scheme), configuration_of);
  return static_cast<size_t>(found - names.begin());
}

RunComparison compare_runs(const RunRecord& a, const RunRecord& b, const FrameSet& frames,
                           const std::vector<SchemePair>& map) {
  RunComparison out;
  out.options = option_differences(a.path, b.path);
  std::vector<SchemePair> schemes = map;
  if (map.empty()) {
    out.schemes_only_a = missing_from(b.scheme_names, a.scheme_names);
    out.schemes_only_b = missing_from(a.scheme_names, b.scheme_names);
    for (const std::string& name : a.scheme_names) schemes.push_back({name, name});
  }

  const auto frames_a = measured_frames(a, frames), frames_b = measured_frames(b, frames);
  std::vector<std::pair<const FrameStatistics*, const FrameStatistics*>> pairs;
  for (const auto& [key, frame] : frames_a) {
    const auto partner = frames_b.find(key);
    if (partner == frames_b.end()) {
      ++out.only_a;
      continue;
    }
    pairs.emplace_back(frame, partner->second);
    if (!same_picture(*frame, *partner->second)) ++out.different_pictures;
  }
  out.common = pairs.size();
  out.only_b = frames_b.size() - pairs.size();

  for (const SchemePair& pair : schemes) {
    const size_t i = scheme_position(a.scheme_names, pair.a), j = scheme_position(b.scheme_names, pair.b);
    if (i == a.scheme_names.size() || j == b.scheme_names.size()) continue;
    SchemeComparison scheme;
    scheme.scheme = pair.text();
    scheme.a.burst_bits = a.burst_bits;
    scheme.b.burst_bits = b.burst_bits;
    for (const auto& [frame_a, frame_b] : pairs) {
      const SchemeStatistics &of_a = frame_a->schemes[i], &of_b = frame_b->schemes[j];
      // A frame that was cut off when its program was killed has no sizes.
      if (of_a.raw_bits == 0 || of_b.raw_bits == 0) continue;
      scheme.a += of_a;
      scheme.b += of_b;
      scheme.better += of_b.rate() > of_a.rate();
      scheme.worse += of_b.rate() < of_a.rate();
      scheme.frames.push_back({frame_a->frame, frame_a->surface, of_a, of_b});
    }
    out.schemes.push_back(std::move(scheme));
  }
  return out;
}

double relative_change(double a, double b) {
  if (a == b) return 0;
  return a == 0 ? NAN : (b - a) / a;
}

}  // namespace tilepress
