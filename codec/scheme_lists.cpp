// Scheme lists: the grammar `name:key={a,b},key={a..b}`, which stands for several specifications.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

#include "tilepress/scheme.h"
#include "tilepress/scheme_spec.h"

namespace tilepress {
namespace {

Error bad_list(std::string text) {
  return {ErrorKind::kBadValue, std::move(text)};
}

const SchemeKey* find_key(const SchemeInfo& info, std::string_view name) {
  const auto at = std::ranges::find(info.keys, name, &SchemeKey::name);
  return at != info.keys.end() ? &*at : nullptr;
}

/// The numbers of `first..last`.
Result<std::vector<std::string>> range_values(const SchemeKey& key, std::string_view first,
                                              std::string_view last) {
  const auto number = [](std::string_view text) -> std::optional<uint32_t> {
    uint32_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
  };
  if (key.range == KeyRange::kNone) return bad_list("takes a list such as {a,b}, no range");
  const auto low = number(first), high = number(last);
  if (!low || !high || *low == 0) return bad_list("a range is {A..B} with whole numbers from 1 on");
  if (*low > *high) return bad_list("the range is reversed");
  std::vector<std::string> values;
  for (uint64_t value = *low; value <= *high;
       value = key.range == KeyRange::kDoubling ? 2 * value : value + 1) {
    values.push_back(std::to_string(value));
    if (values.size() > kMostSchemes) break;  // refused as too many
  }
  return values;
}

/// The values of a list, without its braces.
Result<std::vector<std::string>> list_values(const SchemeKey& key, std::string_view list) {
  if (list.find('{') != std::string_view::npos) return bad_list("a list inside a list");
  if (const size_t dots = list.find(".."); dots != std::string_view::npos)
    return range_values(key, list.substr(0, dots), list.substr(dots + 2));
  std::vector<std::string> values;
  for (;;) {
    const size_t comma = list.find(',');
    if (list.substr(0, comma).empty()) return bad_list("a value of the list is empty");
    values.emplace_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return values;
    list = list.substr(comma + 1);
  }
}

/// Splits the text into parts that stand one after another, each with the texts that it may have.
Result<std::vector<std::vector<std::string>>> split_lists(std::string_view text) {
  std::vector<std::vector<std::string>> parts;
  const SchemeInfo* info = find_scheme(text.substr(0, text.find(':')));
  while (!text.empty()) {
    const size_t open = text.find("={");
    const size_t item = text.substr(0, open).find_last_of(":,") + 1;
    const std::string name(text.substr(item, open - item));
    const SchemeKey* key =
        info != nullptr && open != std::string_view::npos ? find_key(*info, name) : nullptr;
    // The parser has the words for a text without a list, or with a key that is unknown or names a file.
    if (key == nullptr || key->kind == KeyKind::kFile) {
      parts.push_back({std::string(text)});
      return parts;
    }
    const size_t close = text.find('}', open);
    if (close == std::string_view::npos) return bad_list(name + ": '{' without '}'; a list has no spaces");
    const auto values = list_values(*key, text.substr(open + 2, close - open - 2));
    if (!values) return about(name, values.error());
    if (close + 1 < text.size() && text[close + 1] != ',')
      return bad_list(name + ": text after '}'; only ',' and the next key may follow");
    parts.push_back({std::string(text.substr(0, open + 1))});
    parts.push_back(*values);
    text = text.substr(close + 1);
  }
  return parts;
}

}  // namespace

Result<std::vector<SchemeSpec>> parse_schemes(std::string_view text) {
  const auto parts = split_lists(text);
  if (!parts) return about("scheme '" + std::string(text) + "'", parts.error());
  std::vector<std::string> texts = {""};
  for (const auto& choices : *parts) {
    std::vector<std::string> longer;
    for (const std::string& begin : texts)
      for (const std::string& choice : choices) longer.push_back(begin + choice);
    texts = std::move(longer);
    if (texts.size() > kMostSchemes)
      return bad_list("scheme '" + std::string(text) + "': more than " + std::to_string(kMostSchemes) +
                      " configurations");
  }
  std::vector<SchemeSpec> schemes;
  for (const std::string& each : texts) {
    auto spec = parse_scheme(each);
    if (!spec) return spec.error();
    if (std::ranges::find(schemes, each, &SchemeSpec::text) == schemes.end())
      schemes.push_back(std::move(*spec));
  }
  return schemes;
}

}  // namespace tilepress
