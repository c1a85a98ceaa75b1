// Messages: what a verb writes on standard error.
#pragma once

#include <cstdint>
#include <string_view>

#include "tilepress/result.h"

namespace tilepress {

enum class MessageLevel : uint8_t { kInfo, kWarning, kError };

/// Makes spdlog's default logger, which replay/ uses too, write "tilepress: LINE" on standard error. Call in
/// main before the first message. Every function below is thread-safe.
void open_messages();

/// Hides messages below `name`, a value of --log-level. Errors cannot be hidden. At first "warn".
void set_message_level(std::string_view name);

/// Writes one line. Line breaks in `line` become spaces and other control characters '?', so that text from a
/// file cannot send a terminal escape sequences.
void say(MessageLevel level, std::string_view line);

/// Writes the error and returns `status`, so that a verb ends with `return fail(...)`.
int fail(int status, std::string_view line);
int fail(int status, const Error& error);

/// Writes text for people as it is, at every level: tables, summaries, and lines that continue a message.
void show(std::string_view text);

/// Shows `line` as the terminal's last line, in place of the one before. Other text takes it away.
void show_progress(std::string_view line);
void clear_progress();

}  // namespace tilepress
