// Nearest word: what a mistyped word probably stands for, for messages that name the way out.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// Returns the known word that needs the fewest slips to become `word`; of equals the first. A slip is a letter
/// that is missing, added, wrong, or swapped with its neighbour. Case and dashes at the start do not count. A word
/// of three or more letters that begins a known word counts as one slip. Returns an empty text if every known word
/// needs more than one slip per three letters.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// Returns a hint to stand behind a fault: " (did you mean 'X'? REST)". Leaves out what there is not: an empty
/// `rest`, or the question if no word is near. Returns an empty text without both.
std::string nearest_hint(std::string_view word, std::span<const std::string_view> known, std::string_view rest = "");

/// The same for words in other containers.
template <class Words>
std::string nearest_hint_of(std::string_view word, const Words& known, std::string_view rest = "") {
  const std::vector<std::string_view> words(std::begin(known), std::end(known));
  return nearest_hint(word, words, rest);
}

/// Returns "a, b or c".
std::string listed_words(std::span<const std::string_view> words, std::string_view last_joint = " or ");

}  // namespace tilepress
