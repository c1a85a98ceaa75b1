// Way out: hints that stand behind the reason of an error.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// Returns " (did you mean 'shots/1.png'?)" if a file or folder of a similar name is where `path` says there is
/// one; else an empty text. Patterns that no shell has replaced count as names.
std::string path_hint(const std::string& path);

/// Whether an X server answers at a local display (":1", ":1.0", "unix:1"). Returns true for a remote one.
bool x_server_answers(const std::string& display);

/// Two indented lines on how to run `verb` without a display. Empty if the environment names an X server that
/// answers, or a Wayland compositor.
std::string display_hint(const std::string& verb);

/// Returns `text` as one word of a shell's command line, in single quotes where it needs them.
std::string shell_word(const std::string& text);

/// "  next: tilepress report DIR -o report.html", a line that ends the summary of finished runs in `folder`.
std::string next_command(const std::string& folder);

/// Returns those of `paths` that do not exist. "-" exists.
std::vector<std::string> missing_paths(const std::vector<std::string>& paths);

/// "PATH: No such file or directory", with the path's hint.
std::string missing_text(const std::string& path);

/// Fails with kFile, "PATH: there is no folder FOLDER", if the folder of a file to be made is missing.
Result<void> check_folder_of(const std::string& path);

}  // namespace tilepress
