// Fuzz target for the trace reader: whole files as they are, and event streams in a valid container.
#include <snappy.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/trace_summary.h"

namespace {

constexpr tilepress::TraceLimits kLimits = {.free_stream_bytes = 8 << 20, .max_expansion = 100};

void check(std::span<const uint8_t> file) {
  const auto summary = tilepress::summarize_trace(file, kLimits);
  if (!summary) {
    const std::string& reason = summary.error().text;
    if (reason.empty() || reason.find('\n') != std::string::npos) __builtin_trap();
    return;
  }
  uint64_t frames = 0;
  for (const tilepress::TraceSurface& surface : summary->surfaces) frames += surface.frames;
  if (frames != summary->frames || summary->frames > summary->calls) __builtin_trap();
  if ((summary->state == tilepress::TraceState::kComplete) != summary->reason.empty()) __builtin_trap();
}

}  // namespace

/// The first byte chooses: even = the rest is a file, odd = the rest is an event stream.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  if (size == 0) return 0;
  const std::span<const uint8_t> rest(bytes + 1, size - 1);
  if (bytes[0] % 2 == 0) {
    check(rest);
    return 0;
  }
  std::string packed;
  snappy::Compress(reinterpret_cast<const char*>(rest.data()), rest.size(), &packed);
  std::vector<uint8_t> file = {'a', 't'};
  for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<uint8_t>(packed.size() >> shift));
  file.insert(file.end(), packed.begin(), packed.end());
  check(file);
  return 0;
}
