// Scheme specifications: `name:key=value,key=value`, parsed and checked against the scheme's key table. A
// value may be a list in braces, which stands for several specifications.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// A key's value: a number or the position of a choice, a share from 0 to 1, or the numbers of a file.
using SchemeValue = std::variant<uint32_t, double, std::vector<uint32_t>>;

/// A scheme with its options.
struct SchemeSpec {
  std::string text;  ///< as the user wrote it; names the scheme in every output
  std::string name;  ///< the part before ':', a name of the registry
  /// One per key of the scheme's table, in its order. A key that the text does not name has its default.
  std::vector<std::pair<std::string_view, SchemeValue>> values;

  // Precondition: the scheme's table has the key, with a value of this type.
  uint32_t number(std::string_view key) const { return std::get<uint32_t>(value(key)); }
  double share(std::string_view key) const { return std::get<double>(value(key)); }
  const std::vector<uint32_t>& list(std::string_view key) const {
    return std::get<std::vector<uint32_t>>(value(key));
  }

 private:
  const SchemeValue& value(std::string_view key) const;
};

/// What a key that names a file does: read the file, or keep nothing of it. A decoder needs only the frame's
/// own tables and must not open a file that someone else named.
enum class SchemeFiles : uint8_t { kRead, kLeave };

/// Parses one specification.
Result<SchemeSpec> parse_scheme(std::string_view text, SchemeFiles files = SchemeFiles::kRead);

/// The most configurations that one call may name.
constexpr size_t kMostSchemes = 256;

/// Parses a specification whose values may be lists: `fvc={16,32}`, or a range `fvc={16..512}` for a key with
/// a KeyRange. Several lists multiply; the last key varies fastest. Each result is named as if typed alone;
/// equal names appear once. Error: kBadValue, also for more than kMostSchemes.
Result<std::vector<SchemeSpec>> parse_schemes(std::string_view text);

/// The seven schemes of the paper, in the order in which it describes them.
std::vector<SchemeSpec> default_schemes();

}  // namespace tilepress
