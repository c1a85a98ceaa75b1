// Choice option: a command-line option that takes one of a few words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace tilepress {

/// Adds `flags`. Each word of `choices` sets `value`, which must outlive the parsing, to the word's value.
/// The help shows the words as "a|b|c".
template <typename T>
void add_choice_option(CLI::App& app, const std::string& flags, T& value,
                       const std::vector<std::pair<std::string, T>>& choices, const std::string& text) {
  std::string form, list;
  for (const auto& [word, meaning] : choices) {
    form += (form.empty() ? "" : "|") + word;
    list += (list.empty() ? "" : ", ") + word;
  }
  app.add_option_function<std::string>(
         flags,
         [&value, choices, flags, list](const std::string& given) {
           for (const auto& [word, meaning] : choices)
             if (word == given) {
               value = meaning;
               return;
             }
           throw CLI::ValidationError(flags + " " + given + ": not one of " + list);
         },
         text)
      ->type_name(form);
}

}  // namespace tilepress
