// Plugin scheme: checks a plugin's table, tries it on a small picture and registers it.
#include "tilepress/plugin_scheme.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstring>
#include <deque>
#include <map>
#include <string>

#include "plugin/plugin_table.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/statistics_rows.h"
#include "tilepress/surface_engine.h"

namespace tilepress {
namespace {

/// Size of the table in the first release of the interface. Later members stand behind.
constexpr size_t kFirstTableBytes = offsetof(tp_scheme, decode) + sizeof(tp_scheme::decode);

/// What the registry points to. Never destroyed: engines of other threads may outlive static objects.
struct PluginEntry {
  tp_scheme table;  ///< members that an older plugin lacks are zero
  std::vector<SchemeKey> keys;
};

std::map<std::string, PluginEntry, std::less<>>& entries() {
  static auto& known = *new std::map<std::string, PluginEntry, std::less<>>;
  return known;
}

bool is_word(const char* text) {
  if (text == nullptr || *text == '\0') return false;
  const std::string_view word = text;
  return std::ranges::all_of(word,
                             [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

bool is_line(const char* text) {
  return text != nullptr && *text != '\0' && std::string_view(text).find('\n') == std::string_view::npos;
}

std::string check_functions(const tp_scheme& table) {
  const std::pair<const char*, bool> required[] = {{"create", table.create != nullptr},
                                                   {"csb_bits", table.csb_bits != nullptr},
                                                   {"encode", table.encode != nullptr},
                                                   {"decode", table.decode != nullptr}};
  for (const auto& [name, there] : required)
    if (!there) return std::string("the function ") + name + "() is missing";
  if ((table.table_bits == nullptr) != (table.write_tables == nullptr))
    return "table_bits() and write_tables() come together or not at all";
  if (table.table_bits != nullptr && table.begin_decoding == nullptr)
    return "the function begin_decoding() is missing, which takes the tables";
  return "";
}

std::string check_columns(const tp_scheme& table) {
  if (table.column_count > kOwnCounts) return "more than 4 columns";
  if (table.column_count > 0 && table.columns == nullptr) return "columns is NULL";
  std::string header = ",";
  header += schemes_csv_header();
  header.back() = ',';
  for (uint32_t i = 0; i < table.column_count; ++i) {
    if (!is_word(table.columns[i])) return "column " + std::to_string(i) + " has no name for a column";
    const std::string name = std::string(table.columns[i]) + ",";
    if (header.find("," + name) != std::string::npos)
      return std::string("schemes.csv has a column '") + table.columns[i] + "' already";
    header += name;
  }
  return "";
}

size_t choice_count(const char* choices) {
  size_t count = 1;
  for (std::string_view rest = choices; (rest.find(", ")) != rest.npos; ++count)
    rest.remove_prefix(rest.find(", ") + 2);
  return count;
}

/// Converts a key, or returns why it is none.
std::string take_key(const tp_scheme_key& key, SchemeKey& out) {
  if (!is_word(key.name)) return "a key has no name";
  const auto fault = [&](const char* what) { return std::string("key '") + key.name + "': " + what; };
  if (!is_line(key.summary)) return fault("has no summary of one line");
  out = SchemeKey{.name = key.name, .summary = key.summary, .initial = key.initial};
  switch (key.kind) {
    case TP_KEY_CHOICE:
      if (!is_line(key.choices)) return fault("has no choices");
      if (key.initial >= choice_count(key.choices)) return fault("the default is no choice");
      out.kind = KeyKind::kChoice;
      out.choices = key.choices;
      return "";
    case TP_KEY_POWER_OF_TWO:
      if (!std::has_single_bit(key.low) || !std::has_single_bit(key.initial))
        return fault("lowest value and default must be powers of two");
      out.kind = KeyKind::kPowerOfTwo;
      out.range = KeyRange::kDoubling;
      break;
    case TP_KEY_NUMBER:
      out.range = KeyRange::kCounting;
      break;
    default:
      return fault("its kind is unknown to this tilepress");
  }
  out.low = key.low;
  out.high = std::min(key.high, kLargestNumber);
  if (key.initial < out.low || key.initial > out.high) return fault("the default is out of its range");
  return "";
}

std::string take_keys(const tp_scheme& table, std::vector<SchemeKey>& keys) {
  if (table.key_count > 64) return "more than 64 keys";
  if (table.key_count > 0 && table.keys == nullptr) return "keys is NULL";
  keys.resize(table.key_count);
  for (uint32_t i = 0; i < table.key_count; ++i) {
    if (std::string fault = take_key(table.keys[i], keys[i]); !fault.empty()) return fault;
    for (uint32_t before = 0; before < i; ++before)
      if (std::string_view(keys[before].name) == keys[i].name)
        return std::string("key '") + keys[i].name + "' is there twice";
  }
  return "";
}

SchemeInfo info_of(const tp_scheme& table, std::span<const SchemeKey> keys) {
  SchemeInfo info{.name = table.name,
                  .label = table.label != nullptr ? table.label : table.name,
                  .family = table.name,
                  .summary = table.summary,
                  .source = table.source != nullptr ? table.source : "a plugin",
                  .make_encoder = make_plugin_encoder,
                  .make_decoder = make_plugin_decoder,
                  .keys = keys};
  info.columns = {table.columns, table.column_count};
  info.needs_frame_before = (table.flags & TP_SCHEME_FRAME_BEFORE) != 0;
  info.eight_bit_only = (table.flags & TP_SCHEME_EIGHT_BIT_ONLY) != 0;
  return info;
}

/// A picture with blocks of one colour, of few colours, of slopes and of noise.
constexpr uint32_t kTrySide = 64;
std::vector<uint32_t> picture(uint32_t frame) {
  std::vector<uint32_t> words(kTrySide * kTrySide);
  uint32_t noise = 1;
  for (uint32_t y = 0; y < kTrySide; ++y)
    for (uint32_t x = 0; x < kTrySide; ++x) {
      noise = noise * 1664525u + 1013904223u;
      const uint32_t kinds[] = {0xFF204060u, 0xFF000000u + 0x010101u * ((x + y) % 3),
                                x * 0x010200u + y + frame, noise};
      words[y * kTrySide + x] = kinds[(x / 8 + y / 8) % 4];
    }
  return words;
}

/// Compares the bits that measure() returns with those that encode() writes, block by block.
std::string try_scheme(const tp_scheme& table) {
  const auto spec = parse_scheme(table.name);
  if (!spec) return spec.error().text;
  SurfaceEngine measures({*spec}, ModelOptions{}), encodes({*spec}, ModelOptions{});
  BlockBits bits;
  measures.note_block_bits(&bits);
  std::vector<CompressedSurface> surfaces(1);
  FrameStatistics statistics;
  for (uint32_t frame = 0; frame < 2; ++frame) {
    const std::vector<uint32_t> words = picture(frame);
    const SurfaceView view{reinterpret_cast<const std::byte*>(words.data()),
                           ptrdiff_t{kTrySide} * 4,
                           kTrySide,
                           kTrySide,
                           PixelFormat::kRgba8,
                           ByteOrder::kRgba};
    measures.process(view, statistics);
    encodes.process(view, statistics, surfaces);
    for (size_t i = 0; i < bits.schemes[0].size(); ++i)
      if (bits.schemes[0][i] != surfaces[0].block_bits[i])
        return "encode() writes " + std::to_string(surfaces[0].block_bits[i]) +
               " bits where measure() returns " + std::to_string(bits.schemes[0][i]);
  }
  return "";
}

}  // namespace

const tp_scheme& plugin_table(std::string_view name) {
  return entries().find(name)->second.table;
}

Result<void> register_plugin_scheme(const tp_scheme& given) {
  const auto fail = [&](const std::string& reason) { return Error{ErrorKind::kBadValue, reason}; };
  if (given.abi != TP_PLUGIN_ABI)
    return fail("is built for plugin interface " + std::to_string(given.abi) + ", this tilepress has " +
                std::to_string(TP_PLUGIN_ABI) + " (build it with this version's tilepress_plugin.h)");
  if (given.struct_bytes < kFirstTableBytes)
    return fail("its table has " + std::to_string(given.struct_bytes) + " bytes, interface " +
                std::to_string(TP_PLUGIN_ABI) + " has " + std::to_string(kFirstTableBytes));
  tp_scheme table{};
  std::memcpy(&table, &given, std::min<size_t>(given.struct_bytes, sizeof table));
  if (!is_word(table.name)) return fail("a scheme has no name of letters, digits, '_' and '-'");
  const auto fault = [&](const std::string& reason) {
    return fail(std::string("scheme '") + table.name + "': " + reason);
  };
  if (find_scheme(table.name) != nullptr) return fault("there is a scheme of this name already");
  if (!is_line(table.summary)) return fault("has no summary of one line");
  PluginEntry entry{table, {}};
  for (const auto& check : {check_functions(table), check_columns(table), take_keys(table, entry.keys)})
    if (!check.empty()) return fault(check);
  const auto placed = entries().insert_or_assign(table.name, std::move(entry)).first;
  const tp_scheme& kept = placed->second.table;
  if (const auto registered = register_scheme(info_of(kept, placed->second.keys)); !registered)
    return registered;
  Result<void> tried;
  try {
    if (const std::string differs = try_scheme(kept); !differs.empty()) tried = fault(differs);
  } catch (const PluginFault& broken) {
    tried = fail(broken.what());
  }
  if (!tried) forget_newest_scheme();
  return tried;
}

}  // namespace tilepress
