// Cache key: SHA-256 over the lines of the texts.
#include "study/cache/cache_key.h"

#include <cstdlib>
#include <map>

#include "capture/gl_probe.h"
#include "study/cache/cache_format.h"
#include "tilepress/file_digest.h"

namespace tilepress {
namespace {

const GlProbe& renderer_here() {
  static const GlProbe probe = probe_gl();
  return probe;
}

std::string pixel_options(const RenderOptions& options) {
  static const std::map<RetracerChoice, std::string> kRetracers = {
      {RetracerChoice::kAuto, "auto"}, {RetracerChoice::kEgl, "egl"}, {RetracerChoice::kGlx, "glx"}};
  static const std::map<ReplayDisplay, std::string> kDisplays = {{ReplayDisplay::kAuto, "auto"},
                                                                 {ReplayDisplay::kSurfaceless, "surfaceless"},
                                                                 {ReplayDisplay::kXvfb, "xvfb"},
                                                                 {ReplayDisplay::kX11, "x11"}};
  std::string text = "api=" + kRetracers.at(options.retracer) + " display=" + kDisplays.at(options.display);
  // Another X server may draw with another driver.
  const char* display = std::getenv("DISPLAY");
  if (options.display == ReplayDisplay::kX11 && display != nullptr) text += std::string(" ") + display;
  return text;
}

}  // namespace

void probe_renderer() {
  renderer_here();
}

Result<CacheKey> cache_key(const ReplayInput& input, const RenderOptions& options) {
  const auto digest = sha256_of_file(input.path);
  if (!digest) return about(input.path, digest.error());
  if (!input.sha256.empty() && input.sha256 != *digest)
    return Error{ErrorKind::kFile,
                 input.path + ": has SHA-256 " + *digest + ", not " + input.sha256 + " as the manifest says"};
  const GlProbe& probe = renderer_here();
  if (!probe.failure.empty())
    return Error{ErrorKind::kSystem, input.path + ": cannot be rendered here: " + probe.failure};
  CacheKey out;
  out.input_sha256 = *digest;
  out.probed_renderer = probe.renderer;
  out.probed_version = probe.version;
  out.pixel_options = pixel_options(options);
  out.frame_set = input.frames ? input.frames->text() : "";
  std::string text = "frames " + std::to_string(kFrameCacheVersion) + "\n";
  for (const std::string* part :
       {&out.input_sha256, &out.probed_renderer, &out.probed_version, &out.pixel_options, &out.frame_set})
    text += *part + "\n";
  const auto key = sha256_of_bytes(text);
  if (!key) return about(input.path, key.error());
  out.key = *key;
  return out;
}

}  // namespace tilepress
