// Trace options: the command line, and what goes with what.
#include "memory_trace/trace_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "command_line.h"
#include "frames/frame_size.h"
#include "streams/messages.h"
#include "tilepress/scheme.h"
#include "way_out.h"

namespace tilepress {
namespace {

struct FormatName {
  std::string_view name;
  TraceFormat format;
};
constexpr FormatName kFormatNames[] = {
    {"csv", TraceFormat::kCsv},
    {"gem5", TraceFormat::kGem5},
    {"dramsim3", TraceFormat::kDramsim3},
    {"ramulator2", TraceFormat::kRamulator2},
    {"ramulator2-vectors", TraceFormat::kRamulator2Vectors},
    {"ramulator2-data", TraceFormat::kRamulator2Data},
};

constexpr std::string_view kNamePart = "{name}";

std::string format_list(const std::string& separator = ", ") {
  std::string list;
  for (const auto& [name, format] : kFormatNames) list += (list.empty() ? "" : separator) + std::string(name);
  return list;
}

/// Fails if the file cannot be made: known before a capture that may take long.
Result<void> check_path(const MemoryTraceOptions& options) {
  if (options.path == "-" || options.has_name_part()) return {};
  std::error_code code;
  const std::filesystem::path path(options.path);
  if (std::filesystem::is_regular_file(path, code) && !options.force)
    return Error{ErrorKind::kExists, options.path + ": exists; choose another name or remove it"};
  return check_folder_of(options.path);
}

/// The format that the name of a file tells: t.csv, t.gem5.gz.
std::optional<TraceFormat> format_of_name(std::string_view path) {
  for (const std::string_view packed : {".gz", ".zst"})
    if (path.ends_with(packed)) path.remove_suffix(packed.size());
  for (const auto& [name, format] : kFormatNames)
    if (path.ends_with("." + std::string(name))) return format;
  return std::nullopt;
}

Error bad(std::string text) {
  return {ErrorKind::kBadValue, std::move(text)};
}

void set_base(MemoryTraceOptions& options, const std::string& text) {
  std::string_view digits = text;
  const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
  if (hex) digits.remove_prefix(2);
  const auto [end, code] =
      std::from_chars(digits.data(), digits.data() + digits.size(), options.base, hex ? 16 : 10);
  constexpr uint64_t kMost = uint64_t{1} << 48;
  if (code != std::errc() || end != digits.data() + digits.size() || options.base > kMost)
    throw CLI::ValidationError("--trace-base " + text + ": must be an address up to 2^48, as 4096 or 0x80000000");
}

void set_levels(MemoryTraceOptions& options, const std::string& text) {
  const auto levels = parse_numbers<uint32_t, kDramLevels>(text, ',');
  if (!levels || !std::ranges::all_of(*levels, [](uint32_t entries) { return std::has_single_bit(entries); }))
    throw CLI::ValidationError("--trace-levels " + text +
                               ": must be six powers of two: channels, ranks, bank groups, banks, rows, columns");
  options.levels = *levels;
}

}  // namespace

bool MemoryTraceOptions::has_name_part() const {
  return path.find(kNamePart) != std::string::npos;
}

std::string MemoryTraceOptions::path_of(const std::string& run_name) const {
  return has_name_part() ? std::string(path).replace(path.find(kNamePart), kNamePart.size(), run_name) : path;
}

void add_memory_trace_options(CLI::App& app, MemoryTraceOptions& options, const std::string& path_help) {
  constexpr const char* kGroup = "Memory trace";
  if (!path_help.empty())
    app.add_option("--memory-trace", options.path, path_help)->type_name("FILE")->group(kGroup);
  app.add_option_function<std::string>(
         "--trace-format",
         [&options](const std::string& text) {
           const auto* found = std::ranges::find(kFormatNames, text, &FormatName::name);
           if (found == std::end(kFormatNames))
             throw CLI::ValidationError("--trace-format " + text + ": must be one of " + format_list());
           options.format = found->format;
         },
         "Format (default: by the suffix of the file, before .gz or .zst)")
      ->type_name(format_list("|"))
      ->group(kGroup);
  app.add_option("--trace-scheme", options.scheme, "Scheme of the trace, if the run has several")
      ->type_name("SPEC")
      ->group(kGroup);
  app.add_option("--request-bytes", options.request_bytes,
                 "Bytes of a request, whole bursts, a power of two: neighbouring bursts become one request "
                 "(default: one burst)")
      ->type_name("N")
      ->group(kGroup);
  app.add_flag("--raw", options.raw, "Trace the same frames without compression")->group(kGroup);
  app.add_flag("--trace-data", options.content,
               "Write the bytes of each request too (csv, ramulator2-data)")
      ->group(kGroup);
  app.add_option_function<std::string>(
         "--trace-base", [&options](const std::string& text) { set_base(options, text); },
         "Address of the first surface (default: 0)")
      ->type_name("ADDRESS")
      ->group(kGroup);
  app.add_option("--trace-clock", options.clock_mhz, "Clock of dramsim3's cycles (default: 800)")
      ->type_name("MHZ")
      ->check(CLI::Range(0.001, 1e6))
      ->group(kGroup);
  app.add_option_function<std::string>(
         "--trace-levels", [&options](const std::string& text) { set_levels(options, text); },
         "Channels, ranks, bank groups, banks, rows and columns of ramulator2-vectors, columns in requests "
         "(default: 1,1,4,4,65536,64)")
      ->type_name("C,R,G,B,ROW,COL")
      ->group(kGroup);
  app.add_flag("--swap-load-store", options.swap_load_store,
               "Write LD for writes and ST for reads, for versions of Ramulator 2 that exchange them")
      ->group(kGroup);
}

void add_trace_refresh_option(CLI::App& app, MemoryTraceOptions& options) {
  app.add_option("--refresh", options.refresh_hz,
                 "Frames shown per second in the memory trace (default: the recorded times of `run`, else 60)")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 1e6))
      ->group("Memory trace");
}

Result<void> settle_trace_options(MemoryTraceOptions& options) {
  if (!options.format) options.format = format_of_name(options.path);
  if (!options.format)
    return bad(options.path + ": the name tells no format; give --trace-format NAME, one of " + format_list() +
               ", or a name such as trace.csv.zst");
  if (options.content && *options.format != TraceFormat::kCsv && *options.format != TraceFormat::kRamulator2Data)
    return bad("--trace-data: this format has no place for data; csv and ramulator2-data have");
  if (*options.format == TraceFormat::kRamulator2Data) options.content = true;
  if (options.content && options.raw)
    return bad("--raw: only sizes are known of uncompressed frames, no data");
  return check_path(options);
}

Result<void> ask_for_trace(MemoryTraceOptions& options, RunOptions& run) {
  if (options.path.empty()) return {};
  if (const auto settled = settle_trace_options(options); !settled) return settled;
  if (options.scheme.empty() && run.schemes.size() > 1)
    return bad("--memory-trace: memory sees one scheme, and this run has " + std::to_string(run.schemes.size()) +
               "; choose with -s SCHEME or --trace-scheme SCHEME");
  std::string scheme = run.schemes.front().text;
  if (!options.scheme.empty()) {
    const auto spec = parse_scheme(options.scheme);
    if (!spec) return about("--trace-scheme", spec.error());
    if (std::ranges::find(run.schemes, spec->text, &SchemeSpec::text) == run.schemes.end())
      return bad("--trace-scheme " + spec->text + ": not among the schemes of this run; add -s " + spec->text);
    scheme = spec->text;
  }
  if (const auto known = check_traced_scheme(scheme.substr(0, scheme.find(':'))); !known)
    return about("--memory-trace", known.error());
  if (const auto bytes = request_bytes_for(options, run.model.burst_bits); !bytes) return bytes.error();
  run.block_log = scheme;
  run.block_log_data = options.content;
  return {};
}

int fail_trace(const Error& error, int failed) {
  return fail(error.kind == ErrorKind::kBadValue ? kExitUsage : failed, error);
}

Result<void> check_traced_scheme(const std::string& scheme_name) {
  if (scheme_name != "te" && scheme_name != "fbc") return {};
  return bad("scheme " + scheme_name +
             " has further traffic that one pass over the blocks does not show; choose another scheme");
}

Result<uint32_t> request_bytes_for(const MemoryTraceOptions& options, uint32_t burst_bits) {
  const uint32_t burst_bytes = burst_bits / 8;
  if (options.request_bytes == 0) return burst_bytes;
  constexpr uint32_t kMost = 4096;
  if (!std::has_single_bit(options.request_bytes) || options.request_bytes < burst_bytes ||
      options.request_bytes > kMost)
    return bad(fmt::format("--request-bytes {}: must be a power of two from {} (one burst) to {}",
                           options.request_bytes, burst_bytes, kMost));
  return options.request_bytes;
}

}  // namespace tilepress
