// Trace summary: program, API, surfaces and frames of an apitrace trace, found without replaying it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// The window system interface that the recorded program used.
enum class TraceApi : uint8_t { kUnknown, kEgl, kGlx, kWgl, kCgl, kDirect3d };
const char* name_of(TraceApi api);

/// How the file ended.
enum class TraceState : uint8_t {
  kComplete,   ///< read to its end
  kTruncated,  ///< the file ends too early; everything before its end was read
  kCorrupt,    ///< damaged at `offset`; everything before was read
};
const char* name_of(TraceState state);

/// One surface that the recorded program drew to or presented.
struct TraceSurface {
  uint64_t id = 0;      ///< the recorded handle
  uint64_t frames = 0;  ///< presentations
  uint32_t width = 0;   ///< pixels; 0 if the trace does not say
  uint32_t height = 0;
};

struct TraceSummary {
  uint64_t file_bytes = 0;
  uint64_t stream_bytes = 0;  ///< bytes of the event stream that were read, after decompression
  std::string container;      ///< "snappy", "brotli", "gzip"
  uint64_t version = 0, semantic_version = 0;
  std::vector<std::pair<std::string, std::string>> properties;
  std::string program;  ///< path of the recorded program; empty before version 6
  TraceApi api = TraceApi::kUnknown;
  std::string contexts;  ///< client APIs of the contexts that presented frames, as "OpenGL ES 3.2"
  std::string gl_version, gl_renderer;  ///< of the recording machine; empty if the program did not query them
  uint64_t calls = 0;
  uint64_t open_calls = 0;             ///< calls that never returned; a retracer repeats them at the end
  uint64_t threads = 0;                ///< threads that made calls
  uint64_t frames = 0;                 ///< presentations that a retracer repeats, over all surfaces
  std::vector<TraceSurface> surfaces;  ///< presented at least once, in the order of first presentation
  std::optional<uint64_t>
      duration_ns;  ///< between the first and the last GPU time stamp that the program read
  TraceState state = TraceState::kComplete;
  std::string reason;   ///< one line, unless complete
  uint64_t offset = 0;  ///< where reading stopped, in the event stream
};

/// Limits against hostile files.
struct TraceLimits {
  /// Reading stops after this many bytes, or after file size times max_expansion if that is more.
  uint64_t free_stream_bytes = uint64_t{4} << 30;
  uint64_t max_expansion = 20000;
};

/// Reads all of `path` once, as a stream, in bounded memory. Error, without the path: kFile if the file
/// cannot be read, kUnsupported if it is not a trace or has a container or a version that this reader does
/// not know.
Result<TraceSummary> summarize_trace(const std::string& path, const TraceLimits& limits = {});
/// The same for a file in memory.
Result<TraceSummary> summarize_trace(std::span<const uint8_t> file, const TraceLimits& limits = {});
/// Returns true if the container, the header and the first call of `path` can be read. Reads only these.
bool begins_as_trace(const std::string& path);

}  // namespace tilepress
