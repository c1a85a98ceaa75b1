// HTML text: escaping, shown numbers and template slots.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace tilepress {

/// `text` with & < > " ' replaced, fit for element text and quoted attributes.
std::string escape_html(std::string_view text);
/// `text` as the inside of a JSON string that may stand in a script element.
std::string escape_json(std::string_view text);
/// `text` as part of a file name or element id: letters, digits, '.', '-' and '_' stay, others become '_'.
std::string file_slug(std::string_view text);
/// Three decimals, or fewer digits for large values; "–" for NaN.
std::string shown_number(double value);
/// A share of 0..1 as a percentage with one decimal; "–" for NaN.
std::string shown_percent(double share);

/// Replaces each {{name}} of `pattern` by its slot, or by nothing if there is no such slot.
std::string fill_slots(std::string_view pattern,
                       const std::map<std::string, std::string, std::less<>>& slots);

}  // namespace tilepress
