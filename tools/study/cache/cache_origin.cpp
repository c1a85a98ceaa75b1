// Cache origin: one table names the members.
#include "study/cache/cache_origin.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace tilepress {
namespace {

constexpr std::pair<const char*, std::string CacheOrigin::*> kTexts[] = {
    {"key", &CacheOrigin::key},
    {"input", &CacheOrigin::input},
    {"input_sha256", &CacheOrigin::input_sha256},
    {"gl_vendor", &CacheOrigin::gl_vendor},
    {"gl_renderer", &CacheOrigin::gl_renderer},
    {"gl_version", &CacheOrigin::gl_version},
    {"retracer", &CacheOrigin::retracer},
    {"pixel_options", &CacheOrigin::pixel_options},
    {"frame_set", &CacheOrigin::frame_set},
    {"version", &CacheOrigin::version},
    {"rendered", &CacheOrigin::rendered},
    {"reason", &CacheOrigin::reason},
};
constexpr std::pair<const char*, uint64_t CacheOrigin::*> kCounts[] = {
    {"expected_frames", &CacheOrigin::expected_frames},
    {"unsupported_frames", &CacheOrigin::unsupported_frames},
};

}  // namespace

std::string origin_text(const CacheOrigin& origin) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, member] : kTexts) json[name] = origin.*member;
  for (const auto& [name, member] : kCounts) json[name] = origin.*member;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<CacheOrigin> parse_origin(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::kBadBits, "the origin is no JSON object"};
  CacheOrigin origin;
  for (const auto& [name, member] : kTexts)
    if (const auto found = json.find(name); found != json.end() && found->is_string())
      origin.*member = found->get<std::string>();
  for (const auto& [name, member] : kCounts)
    if (const auto found = json.find(name); found != json.end() && found->is_number_unsigned())
      origin.*member = found->get<uint64_t>();
  return origin;
}

}  // namespace tilepress
