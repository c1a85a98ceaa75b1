// Nearest word: the edit distance with swaps (optimal string alignment), over three rows of the table.
#include "tilepress/nearest_word.h"

#include <algorithm>
#include <cctype>

namespace tilepress {
namespace {

std::string plain_letters(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  std::string plain(word);
  for (char& letter : plain) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return plain;
}

size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known) {
  constexpr size_t kLongestWord = 64, kLeastBeginning = 3;
  if (word.size() > kLongestWord) return {};
  const std::string given = plain_letters(word);
  if (given.empty()) return {};
  size_t fewest = std::max<size_t>(1, given.size() / 3) + 1;
  std::string_view nearest;
  for (const std::string_view candidate : known) {
    const std::string plain = plain_letters(candidate);
    size_t slips = slips_between(given, plain);
    if (given.size() >= kLeastBeginning && plain.starts_with(given)) slips = std::min<size_t>(slips, 1);
    // A single letter is near to every other one.
    if (slips >= fewest || slips >= std::max(given.size(), plain.size())) continue;
    fewest = slips;
    nearest = candidate;
  }
  return nearest;
}

std::string nearest_hint(std::string_view word, std::span<const std::string_view> known, std::string_view rest) {
  std::string hint;
  if (const std::string_view nearest = nearest_word(word, known); !nearest.empty())
    hint.append("did you mean '").append(nearest).append("'?");
  if (!hint.empty() && !rest.empty()) hint += ' ';
  hint += rest;
  return hint.empty() ? hint : " (" + hint + ")";
}

std::string listed_words(std::span<const std::string_view> words, std::string_view last_joint) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? last_joint : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace tilepress
