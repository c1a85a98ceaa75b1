// Command line: CLI11 parsing that ends with an exit status, and options that take one of a few words.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exit_status.h"
#include "streams/messages.h"
#include "tilepress/nearest_word.h"

namespace tilepress {

/// Parses argv ([0] is the verb). Returns the exit status if the verb must stop: 0 after printing the help, 2
/// after printing a usage error. Also adds `--config FILE.toml`, which sets options by their long names. The
/// command line wins over the file.
std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv);

/// For a verb that starts a program, `VERB [OPTIONS] -- PROGRAM [ARGS...]`. Parses the verb's own options
/// with `app` and puts everything after the first "--" into `program`. Without a "--", the program begins at
/// the first word that is not an option. Returns the exit status if the verb must stop here.
std::optional<int> parse_launch_line(CLI::App& app, int argc, char** argv, std::vector<std::string>& program);

/// Adds an option that takes one of a few words, by `flags`. Each word of `choices` sets `value`, which must
/// outlive the parsing, to the word's value. The help shows the words as "a|b|c".
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
           std::vector<std::string_view> words;
           for (const auto& [word, meaning] : choices) words.push_back(word);
           throw CLI::ValidationError(flags + " " + given + ": not one of " + list + nearest_hint(given, words));
         },
         text)
      ->type_name(form);
}

}  // namespace tilepress
