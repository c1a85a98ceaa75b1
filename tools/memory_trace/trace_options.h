// Trace options: what a memory trace holds and how it is written.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "exit_status.h"
#include "memory_trace/frame_accesses.h"
#include "tilepress/run_options.h"

namespace tilepress {

enum class TraceFormat : uint8_t { kCsv, kGem5, kDramsim3, kRamulator2, kRamulator2Vectors, kRamulator2Data };

/// Levels of a DRAM address vector: channel, rank, bank group, bank, row, column.
constexpr size_t kDramLevels = 6;

struct MemoryTraceOptions {
  std::string path;    ///< empty: no trace. "{name}" stands for the name of the run
  std::string scheme;  ///< full text; empty: the run's only scheme
  std::optional<TraceFormat> format;  ///< none: by the suffix of `path`
  uint32_t request_bytes = 0;         ///< 0 = a burst
  bool raw = false;
  bool content = false;  ///< write the bytes of each request
  std::optional<double> refresh_hz;
  uint64_t base = 0;         ///< address of the first surface, bytes
  double clock_mhz = 800;    ///< of DRAMsim3's cycles
  bool swap_load_store = false;
  /// Entries of each level, in requests; powers of two.
  std::array<uint32_t, kDramLevels> levels{1, 1, 4, 4, 65536, 64};
  bool force = false;

  TracedForm form() const { return raw ? TracedForm::kRaw : TracedForm::kCompressed; }
  bool has_name_part() const;
  /// `path` for the run of this name.
  std::string path_of(const std::string& run_name) const;
};

constexpr const char* kMemoryTraceHelp =
    "Write the memory requests of one scheme to FILE, in the format that its suffix tells (.csv, .gem5, "
    ".dramsim3, .ramulator2, …, also with .gz or .zst)";
/// The same for runs. The name of a replay's run is that of its trace, else that of the run's folder.
inline const std::string kRunTraceHelp =
    std::string(kMemoryTraceHelp) + "; {name} in it stands for the name of a run";

/// Adds --memory-trace, if `path_help` is not empty, and the options that go with it. `options` must outlive
/// the parsing.
void add_memory_trace_options(CLI::App& app, MemoryTraceOptions& options, const std::string& path_help);
/// Adds --refresh. Verbs that have one of their own do not call it.
void add_trace_refresh_option(CLI::App& app, MemoryTraceOptions& options);

/// Checks the options against each other and the path, and chooses the format. Errors: kBadValue, kExists, kFile.
Result<void> settle_trace_options(MemoryTraceOptions& options);

/// The same, and makes `run` log the blocks that the trace needs. Does nothing without a path.
Result<void> ask_for_trace(MemoryTraceOptions& options, RunOptions& run);

/// Writes an error about the options, and returns the exit status: usage for kBadValue, `failed` for any other.
int fail_trace(const Error& error, int failed = kExitFailed);

/// Refuses schemes whose further traffic one pass over the blocks does not show: te, fbc. Error:
/// kBadValue.
Result<void> check_traced_scheme(const std::string& scheme_name);

/// The bytes of a request for bursts of `burst_bits`. Error: kBadValue.
Result<uint32_t> request_bytes_for(const MemoryTraceOptions& options, uint32_t burst_bits);

}  // namespace tilepress
