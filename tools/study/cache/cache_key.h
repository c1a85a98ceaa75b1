// Cache key: what decides the pixels of a trace's frames.
#pragma once

#include <string>

#include "study/cache/rendering.h"
#include "tilepress/result.h"

namespace tilepress {

struct CacheKey {
  std::string key;           ///< SHA-256 of the texts below, 64 hexadecimal digits
  std::string input_sha256;  ///< of the trace
  /// Of an OpenGL ES 2 context on a surfaceless display, made by the same Mesa as the retracer's context. A
  /// retracer's renderer is known only after a rendering.
  std::string probed_renderer, probed_version;
  std::string pixel_options;  ///< "api=auto display=auto"
  std::string frame_set;      ///< input.frames; empty = all
};

/// Probes the renderer of this host, once per process. The child process of a probe loads drivers. It may wait
/// for ever for a lock that another thread held at the fork, so call this before threads are started.
void probe_renderer();

/// Probes the renderer unless probe_renderer() did. Error, the trace first: the trace cannot be
/// read, has another SHA-256 than the input names, or there is no renderer.
Result<CacheKey> cache_key(const ReplayInput& input, const RenderOptions& options);

}  // namespace tilepress
