// Trace summary: what an apitrace trace holds (program, API, surfaces, frames), found without replaying it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tilepress {

/// The window system interface that the recorded program used.
enum class TraceApi : uint8_t { kUnknown, kEgl, kGlx, kWgl, kCgl, kDirect3d };
const char* name_of(TraceApi api);

/// How the file ended.
enum class TraceState : uint8_t {
  kComplete,   ///< read to its end
  kTruncated,  ///< the file stops in the middle; everything before was read
  kCorrupt,    ///< damaged at `offset`; everything before was read
};
const char* name_of(TraceState state);

/// One surface that the recorded program drew to or presented.
struct TraceSurface {
  uint64_t id = 0;      ///< the recorded handle
  uint64_t frames = 0;  ///< presentations
  uint32_t width = 0;   ///< pixels; 0 where nothing in the trace tells
  uint32_t height = 0;
};

struct TraceSummary {
  uint64_t file_bytes = 0;
  uint64_t stream_bytes = 0;  ///< event stream read, after decompression
  std::string container;      ///< "snappy", "brotli", "gzip"
  uint64_t version = 0, semantic_version = 0;
  std::vector<std::pair<std::string, std::string>> properties;
  std::string program;  ///< path of the recorded program; empty before version 6
  TraceApi api = TraceApi::kUnknown;
  std::string contexts;  ///< client APIs asked for, as "OpenGL ES 3.2"; of the contexts that presented frames
  std::string gl_version, gl_renderer;  ///< as the recording machine reported them; empty if never asked
  uint64_t calls = 0;
  uint64_t open_calls = 0;  ///< of those, calls that never returned; a retracer repeats them at the end
  uint64_t threads = 0;     ///< threads that made calls
  uint64_t frames = 0;      ///< presentations that a retracer repeats, over all surfaces
  std::vector<TraceSurface> surfaces;   ///< those presented at least once, in the order of first presentation
  std::optional<uint64_t> duration_ns;  ///< between the first and the last GPU time stamp the program read
  TraceState state = TraceState::kComplete;
  std::string reason;   ///< one line, unless complete
  uint64_t offset = 0;  ///< into the event stream, where reading stopped
};

/// Limits that keep a hostile file from taking the machine.
struct TraceLimits {
  /// A stream longer than this is refused, unless the file is longer than it divided by max_expansion.
  uint64_t free_stream_bytes = uint64_t{4} << 30;
  uint64_t max_expansion = 20000;
};

/// Reads all of `path` once, streaming, with bounded memory. Nothing if the file is no trace that this reader
/// knows (missing, a directory, empty, another container or version); `error` is then one line without the
/// path.
std::optional<TraceSummary> summarize_trace(const std::string& path, std::string& error,
                                            const TraceLimits& limits = {});
/// Whether `path` begins as a trace: its container, header and first call can be read. Reads no more of it
/// than that takes.
bool begins_as_trace(const std::string& path);
/// As the first, for a file held in memory.
std::optional<TraceSummary> summarize_trace(std::span<const uint8_t> file, std::string& error,
                                            const TraceLimits& limits = {});

}  // namespace tilepress
