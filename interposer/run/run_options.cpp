// Run options: one table of names, each with its check.
#include "tilepress/run_options.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <utility>

#include "tilepress/block.h"

namespace tilepress {
namespace {

/// Sets the option, or returns false with the reason alone: callers put the option's name and value before
/// it.
using Setter = bool (*)(RunOptions&, std::string_view& value, std::string& reason);

bool parse_count(std::string_view text, uint64_t least, uint64_t most, uint64_t& out, std::string& reason) {
  uint64_t value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code == std::errc::result_out_of_range ||
      (code == std::errc() && end == text.data() + text.size() && (value < least || value > most))) {
    reason = "not in " + std::to_string(least) + ".." + std::to_string(most);
    return false;
  }
  if (code != std::errc() || end != text.data() + text.size()) {
    reason = "not a whole number";
    return false;
  }
  out = value;
  return true;
}

bool set_schemes(RunOptions& options, std::string_view& value, std::string& reason) {
  std::vector<SchemeSpec> schemes;
  for (size_t begin = 0; begin < value.size();) {
    const size_t space = std::min(value.find(' ', begin), value.size());
    const std::string_view part = value.substr(begin, space - begin);
    begin = space + 1;
    if (part.empty()) continue;
    auto spec = parse_scheme(part);
    if (!spec) {
      reason = spec.error().text;
      // The parser names the specification, as the callers do.
      const std::string prefix = "scheme '" + std::string(part) + "': ";
      if (reason.starts_with(prefix)) reason.erase(0, prefix.size());
      value = part;
      return false;
    }
    const bool repeated = std::any_of(schemes.begin(), schemes.end(),
                                      [&](const SchemeSpec& s) { return s.text == spec->text; });
    if (!repeated) schemes.push_back(std::move(*spec));
  }
  if (schemes.empty()) {
    reason = "no scheme named";
    return false;
  }
  options.schemes = std::move(schemes);
  return true;
}

bool set_tile(RunOptions& options, std::string_view& value, std::string& reason) {
  uint64_t side = 0;
  if (!parse_count(value, 8, 4096, side, reason)) return false;
  if (side % kBlockSide != 0) {
    reason = "not a multiple of 8";
    return false;
  }
  options.model.tile_side = static_cast<uint32_t>(side);
  return true;
}

bool set_burst(RunOptions& options, std::string_view& value, std::string& reason) {
  uint64_t bits = 0;
  if (!parse_count(value, 16, kMaxRawBlockBits, bits, reason)) return false;
  if ((bits & (bits - 1)) != 0) {
    reason = "not a power of two";
    return false;
  }
  options.model.burst_bits = static_cast<uint32_t>(bits);
  return true;
}

bool set_verify(RunOptions& options, std::string_view& value, std::string& reason) {
  if (value == "1" || value == "true" || value == "on" || value == "yes") {
    options.model.verify = true;
  } else if (value == "0" || value == "false" || value == "off" || value == "no") {
    options.model.verify = false;
  } else {
    reason = "neither 1 nor 0";
    return false;
  }
  return true;
}

bool set_frames(RunOptions& options, std::string_view& value, std::string& reason) {
  auto set = FrameSet::parse(value, reason);
  if (!set) return false;
  options.frames = std::move(*set);
  return true;
}

bool set_every(RunOptions& options, std::string_view& value, std::string& reason) {
  return parse_count(value, 1, 0xFFFFFFFFu, options.every, reason);
}

/// "every:N", or nothing for none.
bool parse_picture_rule(std::string_view value, uint64_t& every, std::string& reason) {
  if (value.empty()) {
    every = 0;
    return true;
  }
  if (value.starts_with("every:")) return parse_count(value.substr(6), 1, 0xFFFFFFFFu, every, reason);
  reason = "not of the form every:N";
  return false;
}

bool set_heatmaps(RunOptions& options, std::string_view& value, std::string& reason) {
  return parse_picture_rule(value, options.heatmaps_every, reason);
}

bool set_dump_frames(RunOptions& options, std::string_view& value, std::string& reason) {
  return parse_picture_rule(value, options.dump_frames_every, reason);
}

bool set_on_full(RunOptions& options, std::string_view& value, std::string& reason) {
  if (value != "block" && value != "drop") {
    reason = "neither block nor drop";
    return false;
  }
  options.on_full = value == "block" ? OnFull::kBlock : OnFull::kDrop;
  return true;
}

bool set_queue(RunOptions& options, std::string_view& value, std::string& reason) {
  uint64_t frames = 0;
  if (!parse_count(value, 1, 64, frames, reason)) return false;
  options.queue_frames = static_cast<uint32_t>(frames);
  return true;
}

constexpr std::pair<std::string_view, Readback> kReadbacks[] = {{"auto", Readback::kAuto},
                                                                {"sync", Readback::kSync},
                                                                {"async", Readback::kAsync},
                                                                {"in-context", Readback::kInContext}};

bool set_readback(RunOptions& options, std::string_view& value, std::string& reason) {
  for (const auto& [name, readback] : kReadbacks) {
    if (value != name) continue;
    options.readback = readback;
    return true;
  }
  reason = "not one of auto, sync, async, in-context";
  return false;
}

std::string readback_name(Readback readback) {
  for (const auto& [name, known] : kReadbacks)
    if (known == readback) return std::string(name);
  return "";
}

struct TriggerName {
  const char* name;
  Trigger trigger;
};

constexpr TriggerName kTriggers[] = {
    {"finish", kTriggerFinish}, {"flush", kTriggerFlush}, {"readpixels", kTriggerReadPixels}};

bool set_trigger(RunOptions& options, std::string_view& value, std::string& reason) {
  uint32_t triggers = 0;
  for (size_t begin = 0; begin <= value.size();) {
    const size_t end = std::min(value.find(',', begin), value.size());
    const std::string_view word = value.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty() && value.empty()) break;
    const auto* found = std::find_if(std::begin(kTriggers), std::end(kTriggers),
                                     [&](const TriggerName& known) { return word == known.name; });
    if (found == std::end(kTriggers)) {
      reason = "not a list of finish, flush, readpixels";
      return false;
    }
    triggers |= found->trigger;
  }
  options.triggers = triggers;
  return true;
}

bool set_targets(RunOptions& options, std::string_view& value, std::string& reason) {
  if (value != "presented" && value != "all") {
    reason = "neither presented nor all";
    return false;
  }
  options.all_targets = value == "all";
  return true;
}

bool set_output(RunOptions& options, std::string_view& value, std::string& reason) {
  if (value.empty()) {
    reason = "no folder named";
    return false;
  }
  options.output = value;
  return true;
}

bool set_log_level(RunOptions& options, std::string_view& value, std::string& reason) {
  for (std::string_view level : {"trace", "debug", "info", "warn", "error", "off"}) {
    if (value != level) continue;
    options.log_level = value;
    return true;
  }
  reason = "not one of trace, debug, info, warn, error, off";
  return false;
}

bool set_log_file(RunOptions& options, std::string_view& value, std::string&) {
  options.log_file = value;
  return true;
}

struct OptionEntry {
  const char* name;
  const char* variable;
  Setter set;
};

// What is wrong with the others has to be written somewhere: the log comes first.
constexpr OptionEntry kOptions[] = {
    {"log-level", "TILEPRESS_LOG_LEVEL", set_log_level},
    {"log-file", "TILEPRESS_LOG_FILE", set_log_file},
    {"output", "TILEPRESS_OUT", set_output},
    {"scheme", "TILEPRESS_SCHEME", set_schemes},
    {"tile", "TILEPRESS_TILE", set_tile},
    {"burst", "TILEPRESS_BURST", set_burst},
    {"frames", "TILEPRESS_FRAMES", set_frames},
    {"every", "TILEPRESS_EVERY", set_every},
    {"verify", "TILEPRESS_VERIFY", set_verify},
    {"heatmaps", "TILEPRESS_HEATMAPS", set_heatmaps},
    {"dump-frames", "TILEPRESS_DUMP_FRAMES", set_dump_frames},
    {"on-full", "TILEPRESS_ON_FULL", set_on_full},
    {"queue", "TILEPRESS_QUEUE", set_queue},
    {"readback", "TILEPRESS_READBACK", set_readback},
    {"trigger", "TILEPRESS_TRIGGER", set_trigger},
    {"targets", "TILEPRESS_TARGETS", set_targets},
};

std::string scheme_list(const std::vector<SchemeSpec>& schemes) {
  std::string list;
  for (const SchemeSpec& spec : schemes) {
    if (!list.empty()) list += ' ';
    list += spec.text;
  }
  return list;
}

std::string picture_rule(uint64_t every) {
  return every == 0 ? "" : "every:" + std::to_string(every);
}

}  // namespace

std::string trigger_list(uint32_t triggers) {
  std::string list;
  for (const TriggerName& known : kTriggers)
    if ((triggers & known.trigger) != 0) list.append(list.empty() ? "" : ",").append(known.name);
  return list;
}

bool set_run_option(RunOptions& options, std::string_view name, std::string_view value, std::string& error) {
  for (const OptionEntry& entry : kOptions) {
    if (name != entry.name) continue;
    std::string reason;
    if (entry.set(options, value, reason)) return true;
    error = std::string(name) + " " + (value.empty() ? "''" : std::string(value)) + ": " + reason;
    return false;
  }
  error = std::string(name) + ": unknown option";
  return false;
}

std::map<std::string, std::string> to_environment(const RunOptions& options) {
  return {
      {"TILEPRESS_OUT", options.output},
      {"TILEPRESS_SCHEME", scheme_list(options.schemes)},
      {"TILEPRESS_TILE", std::to_string(options.model.tile_side)},
      {"TILEPRESS_BURST", std::to_string(options.model.burst_bits)},
      {"TILEPRESS_FRAMES", options.frames.text()},
      {"TILEPRESS_EVERY", std::to_string(options.every)},
      {"TILEPRESS_VERIFY", options.model.verify ? "1" : "0"},
      {"TILEPRESS_HEATMAPS", picture_rule(options.heatmaps_every)},
      {"TILEPRESS_DUMP_FRAMES", picture_rule(options.dump_frames_every)},
      {"TILEPRESS_ON_FULL", options.on_full == OnFull::kBlock ? "block" : "drop"},
      {"TILEPRESS_QUEUE", std::to_string(options.queue_frames)},
      {"TILEPRESS_READBACK", readback_name(options.readback)},
      {"TILEPRESS_TRIGGER", trigger_list(options.triggers)},
      {"TILEPRESS_TARGETS", options.all_targets ? "all" : ""},
      {"TILEPRESS_LOG_LEVEL", options.log_level},
      {"TILEPRESS_LOG_FILE", options.log_file},
  };
}

bool from_environment(RunOptions& options, std::string& error) {
  for (const OptionEntry& entry : kOptions) {
    const char* text = std::getenv(entry.variable);
    if (text == nullptr || *text == '\0') continue;
    std::string reason;
    std::string_view value = text;
    if (entry.set(options, value, reason)) continue;
    error = std::string(entry.variable) + "=" + std::string(value) + ": " + reason;
    return false;
  }
  return true;
}

}  // namespace tilepress
