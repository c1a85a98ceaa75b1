// Run option table: how options are read and printed, and a row for each.
#include "tilepress/run_option_table.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <ranges>
#include <utility>

#include "tilepress/block.h"
#include "tilepress/csv_table.h"
#include "tilepress/dram_presets.h"
#include "tilepress/nearest_word.h"
#include "tilepress/plugin_library.h"

namespace tilepress {
namespace {

std::string_view shown(std::string_view value) {
  return value.empty() ? "''" : value;
}

Result<void> refuse(const RunOption& option, std::string_view value) {
  return about(shown(value), {ErrorKind::kBadValue, "must be " + std::string(option.range)});
}

/// The error for a word that is none of the names of `choices`.
template <class Choices>
Result<void> refuse_word(const RunOption& option, std::string_view value, std::string_view word,
                         const Choices& choices) {
  std::vector<std::string_view> names;
  for (const auto& choice : choices) names.push_back(choice.name);
  Error error = refuse(option, value).error();
  error.text += nearest_hint(word, names);
  return error;
}

// Below, `member` maps options, const or not, to a reference to one of their members.

std::optional<uint64_t> parse_count(std::string_view text, uint64_t least, uint64_t most) {
  uint64_t value = 0;
  const bool fits = read_csv(text, value) && value >= least && value <= most;
  return fits ? std::optional(value) : std::nullopt;
}

constexpr bool any(uint64_t) {
  return true;
}
constexpr bool whole_blocks(uint64_t side) {
  return side % kBlockSide == 0;
}
constexpr bool power_of_two(uint64_t bits) {
  return std::has_single_bit(bits);
}

template <auto member, uint64_t least, uint64_t most, bool (*fits)(uint64_t) = any>
constexpr OptionText kCount = {
    [](const RunOption& option, RunOptions& options, std::string_view value) -> Result<void> {
      const auto count = parse_count(value, least, most);
      if (!count || !fits(*count)) return refuse(option, value);
      auto& target = member(options);
      target = static_cast<std::remove_reference_t<decltype(target)>>(*count);
      return {};
    },
    [](const RunOptions& options) { return std::to_string(member(options)); }};

constexpr uint64_t kMaxPeriod = 0xFFFFFFFFu;

/// "every:N", or nothing for never.
template <auto member>
constexpr OptionText kPeriod = {
    [](const RunOption& option, RunOptions& options, std::string_view value) -> Result<void> {
      constexpr std::string_view kStart = "every:";
      auto every = value.empty() ? std::optional<uint64_t>(0) : std::nullopt;
      if (value.starts_with(kStart)) every = parse_count(value.substr(kStart.size()), 1, kMaxPeriod);
      if (!every) return refuse(option, value);
      member(options) = *every;
      return {};
    },
    [](const RunOptions& options) {
      return member(options) == 0 ? "" : "every:" + std::to_string(member(options));
    }};

template <auto member, bool may_be_empty = true>
constexpr OptionText kText = {
    [](const RunOption& option, RunOptions& options, std::string_view value) -> Result<void> {
      if (value.empty() && !may_be_empty) return refuse(option, value);
      member(options) = value;
      return {};
    },
    [](const RunOptions& options) { return member(options); }};

template <class T>
struct Choice {
  std::string_view name;
  T value;
};
constexpr Choice<bool> kSwitch[] = {{"1", true},  {"true", true},   {"on", true},   {"yes", true},
                                    {"0", false}, {"false", false}, {"off", false}, {"no", false}};
constexpr Choice<bool> kTargets[] = {{"presented", false}, {"all", true}};
constexpr Choice<OnFull> kOnFull[] = {{"block", OnFull::kBlock}, {"drop", OnFull::kDrop}};
constexpr Choice<Readback> kReadbacks[] = {{"auto", Readback::kAuto},
                                           {"sync", Readback::kSync},
                                           {"async", Readback::kAsync},
                                           {"in-context", Readback::kInContext}};
constexpr Choice<std::string_view> kLogLevels[] = {{"trace", "trace"}, {"debug", "debug"}, {"info", "info"},
                                                   {"warn", "warn"},   {"error", "error"}, {"off", "off"}};
constexpr Choice<Trigger> kTriggers[] = {
    {"finish", kTriggerFinish}, {"flush", kTriggerFlush}, {"readpixels", kTriggerReadPixels}};

/// Of several names for a value the first is printed.
template <const auto& choices, auto member>
constexpr OptionText kChoice = {
    [](const RunOption& option, RunOptions& options, std::string_view value) -> Result<void> {
      for (const auto& choice : choices) {
        if (value != choice.name) continue;
        member(options) = choice.value;
        return {};
      }
      return refuse_word(option, value, value, choices);
    },
    [](const RunOptions& options) {
      for (const auto& choice : choices)
        if (choice.value == member(options)) return std::string(choice.name);
      return std::string();
    }};

Result<void> set_triggers(const RunOption& option, RunOptions& options, std::string_view value) {
  uint32_t triggers = 0;
  for (const auto& part : std::views::split(value, ',')) {
    const std::string_view word(part.begin(), part.end());
    const auto* found = std::ranges::find(kTriggers, word, &Choice<Trigger>::name);
    if (found == std::end(kTriggers)) return refuse_word(option, value, word, kTriggers);
    triggers |= found->value;
  }
  options.triggers = triggers;
  return {};
}

std::string print_triggers(const RunOptions& options) {
  std::string list;
  for (const auto& [name, trigger] : kTriggers)
    if ((options.triggers & trigger) != 0) list.append(list.empty() ? "" : ",").append(name);
  return list;
}

/// Loads the libraries of a list with colons into the process. A name with a colon cannot be in it.
Result<void> set_plugins(const RunOption&, RunOptions&, std::string_view value) {
  for (const auto& word : std::views::split(value, ':')) {
    const std::string path(word.begin(), word.end());
    if (path.empty()) continue;
    if (const auto loaded = load_plugin(path); !loaded)
      return about(path, {ErrorKind::kBadValue, loaded.error().text});
  }
  return {};
}

std::string print_plugins(const RunOptions&) {
  std::string list;
  for (const PluginLibrary& library : loaded_plugins())
    list.append(list.empty() ? "" : ":").append(library.path);
  return list;
}

Result<void> set_schemes(const RunOption& option, RunOptions& options, std::string_view value) {
  std::vector<SchemeSpec> schemes;
  for (const auto& word : std::views::split(value, ' ')) {
    const std::string_view part(word.begin(), word.end());
    if (part.empty()) continue;
    auto specs = parse_schemes(part);
    if (!specs) {
      Error error = specs.error();
      // The parser names the scheme, and so does this error.
      const std::string subject = "scheme '" + std::string(part) + "': ";
      if (error.text.starts_with(subject)) error.text.erase(0, subject.size());
      return about(part, error);
    }
    for (SchemeSpec& spec : *specs)
      if (std::ranges::find(schemes, spec.text, &SchemeSpec::text) == schemes.end())
        schemes.push_back(std::move(spec));
    if (schemes.size() > kMostSchemes)
      return about(part,
                   {ErrorKind::kBadValue, "more than " + std::to_string(kMostSchemes) + " configurations"});
  }
  if (schemes.empty()) return refuse(option, value);
  options.schemes = std::move(schemes);
  return {};
}

std::string print_schemes(const RunOptions& options) {
  std::string list;
  for (const SchemeSpec& spec : options.schemes) list += (list.empty() ? "" : " ") + spec.text;
  return list;
}

/// The preset sets the burst.
Result<void> set_dram(const RunOption& option, RunOptions& options, std::string_view value) {
  const auto* found = std::ranges::find(kDramPresets, value, &DramPreset::name);
  if (found == std::end(kDramPresets)) return refuse_word(option, value, value, kDramPresets);
  options.dram = value;
  options.model.burst_bits = found->burst_bits;
  return {};
}

/// A burst is whole beats. Empty: no toggles.
Result<void> set_toggles(const RunOption& option, RunOptions& options, std::string_view value) {
  const uint32_t bits = value == "16" ? 16 : value == "32" ? 32 : 0;
  if (bits == 0 && !value.empty()) return refuse(option, value);
  if (bits > options.model.burst_bits)
    return about(shown(value), {ErrorKind::kBadValue, "must not be wider than --burst"});
  options.model.toggle_bits = bits;
  return {};
}

std::string print_toggles(const RunOptions& options) {
  return options.model.toggle_bits == 0 ? "" : std::to_string(options.model.toggle_bits);
}

Result<void> set_frames(const RunOption&, RunOptions& options, std::string_view value) {
  auto set = FrameSet::parse(value);
  if (!set) return about(shown(value), set.error());
  options.frames = std::move(*set);
  return {};
}

#define TP_MEMBER(path)        \
  [](auto& options) -> auto& { \
    return options.path;       \
  }

// clang-format off
constexpr RunOption kOptions[] = {
    // The log comes first, because the log takes the errors in the other variables.
    {.name = "log-level", .variable = "TILEPRESS_LOG_LEVEL",
     .range = "trace, debug, info, warn, error or off",
     .text = kChoice<kLogLevels, TP_MEMBER(log_level)>,
     .flags = "--log-level", .metavar = "trace|debug|info|warn|error|off",
     .help = "Least serious message to log (default: warn)"},
    {.name = "log-file", .variable = "TILEPRESS_LOG_FILE", .range = "a file",
     .text = kText<TP_MEMBER(log_file)>},
    {.name = "output", .variable = "TILEPRESS_OUT", .range = "a folder",
     .text = kText<TP_MEMBER(output), false>,
     .flags = "-o,--output", .metavar = "DIR", .help = "Folder for the results"},
    // Before the schemes, which it may bring.
    {.name = "plugin", .variable = "TILEPRESS_PLUGIN", .range = "a shared library",
     .text = {set_plugins, print_plugins},
     .json = {JsonForm::kText, "plugin"},
     .flags = "--plugin", .metavar = "FILE", .joint = ':',
     .help = "Shared library with further schemes for -s; repeat for more (see codec/plugin/README.md)"},
    {.name = "scheme", .variable = "TILEPRESS_SCHEME", .range = "a scheme; see tilepress schemes",
     .text = {set_schemes, print_schemes},
     .json = {JsonForm::kList, "schemes"}, .rows = RowsEffect::kValue,
     .flags = "-s,--scheme", .metavar = "SPEC", .joint = ' ',
     .help = "Scheme as name:key=value,key={a,b},... ; repeat for more (default: the paper's seven; see tilepress schemes)"},
    {.name = "tile", .variable = "TILEPRESS_TILE", .range = "a multiple of 8 in 8..4096",
     .text = kCount<TP_MEMBER(model.tile_side), 8, 4096, whole_blocks>,
     .json = {JsonForm::kNumber, "tile"}, .rows = RowsEffect::kAssigned,
     .flags = "--tile", .metavar = "N",
     .help = "Side of a render tile in pixels, a multiple of 8 (default: 32)"},
    {.name = "burst", .variable = "TILEPRESS_BURST", .range = "a power of two in 16..2048",
     .text = kCount<TP_MEMBER(model.burst_bits), 16, kMaxRawBlockBits, power_of_two>,
     .json = {JsonForm::kNumber, "burst"}, .rows = RowsEffect::kAssigned,
     .flags = "--burst", .metavar = "BITS", .help = "DRAM transfer unit, a power of two (default: 128)"},
    {.name = "dram", .variable = "TILEPRESS_DRAM", .range = "paper, lpddr3, lpddr4 or lpddr5",
     .text = {set_dram, [](const RunOptions& options) { return options.dram; }},
     .json = {JsonForm::kText, "dram"},
     .flags = "--dram", .metavar = "paper|lpddr3|lpddr4|lpddr5",
     .help = "Burst of a DRAM in place of --burst: 128 bits for paper, 256 bits for the others"},
    {.name = "toggles", .variable = "TILEPRESS_TOGGLES", .range = "16 or 32",
     .text = {set_toggles, print_toggles},
     .json = {JsonForm::kText, "toggles"}, .rows = RowsEffect::kUnlessDefault,
     .flags = "--toggles", .metavar = "16|32",
     .help = "Count the bit toggles on a memory bus of 16 or 32 bits, with and without inversion"},
    {.name = "verify", .variable = "TILEPRESS_VERIFY", .range = "1 or 0",
     .text = kChoice<kSwitch, TP_MEMBER(model.verify)>,
     .json = {JsonForm::kBoolean, "verify"}, .rows = RowsEffect::kAssigned,
     .flags = "--verify", .help = "Encode, decode and compare every block; a mismatch is exit 1"},
    {.name = "frames", .variable = "TILEPRESS_FRAMES", .range = "frames and ranges of frames, as 0-99,200",
     .text = {set_frames, [](const RunOptions& options) { return options.frames.text(); }},
     .json = {JsonForm::kText, "frames"}, .rows = RowsEffect::kAssigned,
     .flags = "--frames", .metavar = "RANGES",
     .help = "Only these frames, as 0-99,200 (default: every frame)"},
    {.name = "every", .variable = "TILEPRESS_EVERY", .range = "a number in 1..4294967295",
     .text = kCount<TP_MEMBER(every), 1, kMaxPeriod>,
     .json = {JsonForm::kNumber, "every"}, .rows = RowsEffect::kAssigned,
     .flags = "--every", .metavar = "N", .help = "Only every N-th frame. Palettes and other tables come from the last captured frame, so rates "
             "differ from those of the same frames in a whole run"},
    {.name = "heatmaps", .variable = "TILEPRESS_HEATMAPS", .range = "every:N",
     .text = kPeriod<TP_MEMBER(heatmaps_every)>,
     .flags = "--heatmaps", .metavar = "every:N",
     .help = "Keep the bits of each block of every N-th frame, as DIR/heatmaps/*.pgm"},
    {.name = "dump-frames", .variable = "TILEPRESS_DUMP_FRAMES", .range = "every:N",
     .text = kPeriod<TP_MEMBER(dump_frames_every)>,
     .flags = "--dump-frames", .metavar = "every:N",
     .help = "Keep the pixels of every N-th frame, as DIR/frames/*.png"},
    {.name = "block-log", .variable = "TILEPRESS_BLOCK_LOG", .range = "a scheme of the run",
     .text = kText<TP_MEMBER(block_log)>},
    {.name = "block-log-data", .variable = "TILEPRESS_BLOCK_LOG_DATA", .range = "1 or 0",
     .text = kChoice<kSwitch, TP_MEMBER(block_log_data)>},
    {.name = "on-full", .variable = "TILEPRESS_ON_FULL", .range = "block or drop",
     .text = kChoice<kOnFull, TP_MEMBER(on_full)>,
     .json = {JsonForm::kText, "on_full"},
     .flags = "--on-full", .metavar = "block|drop",
     .help = "When frames come faster than tilepress compresses them: hold the program, or drop frames and "
             "count them (default: block)"},
    {.name = "queue", .variable = "TILEPRESS_QUEUE", .range = "a number in 1..64",
     .text = kCount<TP_MEMBER(queue_frames), 1, 64>},
    {.name = "readback", .variable = "TILEPRESS_READBACK", .range = "auto, sync, async or in-context",
     .text = kChoice<kReadbacks, TP_MEMBER(readback)>,
     .flags = "--readback", .metavar = "auto|sync|async|in-context",
     .help = "Read frames at once, through pixel buffers, or in the program's own context (default: auto, "
             "which decides by the first frames of a window)"},
    {.name = "trigger", .variable = "TILEPRESS_TRIGGER", .range = "a list of finish, flush, readpixels",
     .text = {set_triggers, print_triggers},
     .json = {JsonForm::kText, "trigger"}, .rows = RowsEffect::kUnlessDefault,
     .flags = "--trigger", .metavar = "finish|flush|readpixels", .joint = ',',
     .help = "For programs that present nothing: GL calls that end a frame, which is the bound framebuffer; "
             "a list with commas"},
    {.name = "targets", .variable = "TILEPRESS_TARGETS", .range = "presented or all",
     .text = kChoice<kTargets, TP_MEMBER(all_targets)>,
     .json = {JsonForm::kText, "targets"}, .rows = RowsEffect::kUnlessDefault,
     .flags = "--targets", .metavar = "presented|all",
     .help = "Capture what is presented, or also each image of the program's own framebuffers as a surface "
             "of its own (default: presented)"},
};
// clang-format on

#undef TP_MEMBER

}  // namespace

std::span<const RunOption> run_option_table() {
  return kOptions;
}

const RunOption* find_run_option(std::string_view name) {
  const auto* found = std::ranges::find(kOptions, name, &RunOption::name);
  return found == std::end(kOptions) ? nullptr : found;
}

}  // namespace tilepress
