// Scheme parser: the grammar `name:key=value,key=value`; ranges come from the scheme's key table.
#include "tilepress/scheme_spec.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <optional>

#include "tilepress/nearest_word.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

template <class Number>
std::optional<Number> parse_number(std::string_view text, Number low, Number high) {
  Number value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = status == std::errc{} && end == text.data() + text.size();
  return whole && value >= low && value <= high ? std::optional(value) : std::nullopt;
}

std::vector<std::string_view> choices_of(const SchemeKey& key) {
  std::vector<std::string_view> choices;
  for (std::string_view rest = key.choices;;) {
    const size_t comma = rest.find(", ");
    choices.push_back(rest.substr(0, comma));
    if (comma == std::string_view::npos) return choices;
    rest = rest.substr(comma + 2);
  }
}

/// What a value of the key must be, for messages.
std::string rule_of(const SchemeKey& key) {
  const std::string low = std::to_string(key.low);
  const std::string high = key.high == kLargestNumber ? "" : " to " + std::to_string(key.high);
  switch (key.kind) {
    case KeyKind::kNumber:
      return "a whole number from " + low + high +
             (key.zero_word != nullptr ? std::string(" or ") + key.zero_word : "");
    case KeyKind::kPowerOfTwo:
      return "a power of two from " + low + high;
    case KeyKind::kShare:
      return "a number from 0 to 1";
    case KeyKind::kFile:
      return "the path of a file";
    case KeyKind::kChoice:
      break;
  }
  return listed_words(choices_of(key));
}

}  // namespace

std::string SchemeKey::values() const {
  if (help_values != nullptr) return help_values;
  if (kind == KeyKind::kShare) return "0 ... 1";
  if (kind == KeyKind::kChoice) return choices;
  if (kind == KeyKind::kFile) return "a path";
  std::string text = std::to_string(low);
  if (kind == KeyKind::kPowerOfTwo)
    for (const uint32_t factor : {2, 4}) text.append(", ").append(std::to_string(factor * low));
  text += " ...";
  return high == kLargestNumber ? text : text.append(" ").append(std::to_string(high));
}

std::string SchemeKey::default_value() const {
  if (help_initial != nullptr) return help_initial;
  if (kind == KeyKind::kFile) return "";
  return kind == KeyKind::kChoice ? std::string(choices_of(*this)[initial]) : std::to_string(initial);
}

namespace {

SchemeValue initial_value(const SchemeKey& key) {
  if (key.kind == KeyKind::kShare) return 0.0;
  if (key.kind == KeyKind::kFile) return std::vector<uint32_t>{};
  return key.initial;
}

Result<SchemeValue> parse_value(const SchemeKey& key, const std::string& text, SchemeFiles files) {
  const Error fault{ErrorKind::kBadValue, "must be " + rule_of(key)};
  if (key.kind == KeyKind::kShare) {
    const auto share = parse_number(text, 0.0, 1.0);
    return share ? Result<SchemeValue>(*share) : fault;
  }
  if (key.kind == KeyKind::kChoice) {
    const auto choices = choices_of(key);
    const auto at = std::find(choices.begin(), choices.end(), text);
    if (at == choices.end()) return Error{fault.kind, fault.text + nearest_hint(text, choices)};
    const SchemeValue value = static_cast<uint32_t>(at - choices.begin());
    return value;
  }
  if (key.kind == KeyKind::kFile) {
    if (files == SchemeFiles::kLeave)
      return text.empty() ? fault : Result<SchemeValue>(std::vector<uint32_t>{});
    auto numbers = key.read_file(text);
    return numbers ? Result<SchemeValue>(std::move(*numbers)) : numbers.error();
  }
  uint32_t number = 0;
  if (key.zero_word == nullptr || text != key.zero_word) {
    const auto parsed = parse_number(text, key.low, key.high);
    if (!parsed || (key.kind == KeyKind::kPowerOfTwo && !std::has_single_bit(*parsed))) return fault;
    number = *parsed;
  }
  const SchemeValue value = number;
  return value;
}

std::vector<std::string_view> key_names(const SchemeInfo& info) {
  std::vector<std::string_view> names;
  for (const SchemeKey& key : info.keys) names.emplace_back(key.name);
  return names;
}

/// "vdcp takes fvc, policy and ways"
std::string keys_text(const SchemeInfo& info) {
  const auto names = key_names(info);
  return std::string(info.name) + " takes " + (names.empty() ? "no key" : listed_words(names, " and "));
}

Error unknown_scheme(const std::string& name) {
  std::vector<std::string_view> known;
  for (const SchemeInfo& scheme : scheme_registry()) known.emplace_back(scheme.name);
  if (name.find(',') != std::string::npos)
    return {ErrorKind::kBadValue, "unknown scheme '" + name + "' (give each scheme an option of its own)"};
  const std::string list =
      nearest_word(name, known).empty() ? "there are " + listed_words(known, " and ") : std::string();
  return {ErrorKind::kBadValue, "unknown scheme '" + name + "'" + nearest_hint(name, known, list)};
}

/// Parses one `key=value` into `spec` and adds the key to `given`.
Result<void> parse_item(std::string_view item, const SchemeInfo& info, SchemeFiles files, SchemeSpec& spec,
                        std::vector<std::string_view>& given) {
  const auto fail = [](std::string text) { return Error{ErrorKind::kBadValue, std::move(text)}; };
  const size_t equals = item.find('=');
  if (equals == std::string_view::npos) return fail(std::string("'").append(item) + "' is not key=value (" + keys_text(info) + ")");
  const std::string key(item.substr(0, equals)), text(item.substr(equals + 1));
  const auto at = std::find_if(info.keys.begin(), info.keys.end(),
                               [&](const SchemeKey& known) { return key == known.name; });
  if (at == info.keys.end()) return fail("unknown key '" + key + "'" + nearest_hint(key, key_names(info), keys_text(info)));
  auto value = parse_value(*at, text, files);
  if (!value) return Error{value.error().kind, key + "=" + text + ": " + value.error().text};
  if (std::find(given.begin(), given.end(), key) != given.end()) return fail("key '" + key + "' given twice");
  spec.values[static_cast<size_t>(at - info.keys.begin())].second = std::move(*value);
  given.push_back(at->name);
  return {};
}

Result<void> parse_items(std::string_view rest, const SchemeInfo& info, SchemeFiles files, SchemeSpec& spec) {
  std::vector<std::string_view> given;
  while (!rest.empty()) {
    const size_t comma = rest.find(',');
    if (comma != std::string_view::npos && comma + 1 == rest.size())
      return Error{ErrorKind::kBadValue, "nothing after the last ','"};
    if (auto parsed = parse_item(rest.substr(0, comma), info, files, spec, given); !parsed) return parsed;
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return info.check != nullptr ? info.check(spec, given) : Result<void>{};
}

}  // namespace

const SchemeValue& SchemeSpec::value(std::string_view key) const {
  const auto at =
      std::find_if(values.begin(), values.end(), [&](const auto& each) { return each.first == key; });
  assert(at != values.end());
  return at->second;
}

Result<SchemeSpec> parse_scheme(std::string_view text, SchemeFiles files) {
  SchemeSpec spec;
  spec.text = text;
  const size_t colon = text.find(':');
  spec.name = text.substr(0, colon);
  const auto fail = [&](ErrorKind kind, const std::string& reason) {
    return Error{kind, "scheme '" + spec.text + "': " + reason};
  };
  const SchemeInfo* info = find_scheme(spec.name);
  if (info == nullptr) return fail(ErrorKind::kBadValue, unknown_scheme(spec.name).text);
  for (const SchemeKey& key : info->keys) spec.values.emplace_back(key.name, initial_value(key));
  const std::string_view items = colon == std::string_view::npos ? "" : text.substr(colon + 1);
  if (colon != std::string_view::npos && items.empty())
    return fail(ErrorKind::kBadValue, "nothing after ':'");
  if (const auto parsed = parse_items(items, *info, files, spec); !parsed)
    return fail(parsed.error().kind, parsed.error().text);
  return spec;
}

std::vector<SchemeSpec> default_schemes() {
  std::vector<SchemeSpec> schemes;
  for (const char* name : {"dcp", "adcp", "vdcp", "huffdcp", "ras", "red", "hdcp"})
    schemes.push_back(*parse_scheme(name));
  return schemes;
}

}  // namespace tilepress
