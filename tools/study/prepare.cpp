// Prepare: a function per kind of workload.
#include "prepare.h"

#include <filesystem>

#include "frames/image_frames.h"
#include "study/cache/frame_cache.h"
#include "study/cache/host_name.h"
#include "study/import_run.h"
#include "study/text_file.h"
#include "study/workload_size.h"
#include "tilepress/file_digest.h"
#include "tilepress/utc_time.h"

namespace tilepress {
namespace {

Result<void> take_cache_file(const std::string& path, PreparedWorkload& prepared) {
  FrameCacheReader reader;
  if (const auto opened = reader.open(path); !opened) return opened;
  WorkloadRecord& record = prepared.record;
  const CacheOrigin& origin = reader.origin();
  record.frames_file = path;
  record.gl_renderer = origin.gl_renderer;
  record.gl_version = origin.gl_version;
  record.retracer = origin.retracer;
  record.rendered = origin.rendered;
  if (record.source_sha256.empty()) record.source_sha256 = origin.input_sha256;
  record.frames = reader.frame_count();
  if (reader.frame_count() == 0 && origin.unsupported_frames > 0)
    return Error{ErrorKind::kUnsupported, "its frames have a format that is not modelled"};
  if (reader.frame_count() == 0) return Error{ErrorKind::kFile, "has no frames"};
  record.frames_digest = reader.frames_digest();
  record.reason = origin.reason;
  if (record.reason.empty() && origin.unsupported_frames > 0)
    record.reason = std::to_string(origin.unsupported_frames) + " frames have a format that is not modelled";
  if (!record.reason.empty()) record.state = "partial";
  prepared.pixels = pixels_of(reader);
  prepared.open = cache_feed(path);
  return {};
}

Result<void> prepare_trace(const Workload& workload, const StudyOptions& options, const std::atomic<int>& stop,
                           PreparedWorkload& prepared) {
  const auto rendering = find_or_render(workload.trace, options.render, stop);
  if (!rendering) return rendering.error();
  prepared.rendered = rendering->rendered;
  prepared.render_seconds = rendering->seconds;
  return take_cache_file(rendering->path, prepared);
}

Result<void> prepare_images(const Workload& workload, PreparedWorkload& prepared) {
  WorkloadRecord& record = prepared.record;
  ImageFrames images;
  if (const auto opened = images.open(workload.paths, std::nullopt); !opened) return opened;
  record.frames = images.count().value_or(0);
  prepared.pixels = record.frames * images.size().pixels();
  std::string digests;
  for (const std::string& path : workload.paths) {
    const auto digest = sha256_of_file(path);
    if (!digest) return about(path, digest.error());
    digests += *digest + "\n";
  }
  const auto digest = sha256_of_bytes(digests);
  if (!digest) return digest.error();
  record.source_sha256 = record.frames_digest = *digest;
  prepared.open = image_feed(workload.paths);
  return {};
}

Result<void> prepare_any(const Workload& workload, const StudyFile& study, const StudyOptions& options,
                         const std::atomic<int>& stop, PreparedWorkload& prepared) {
  switch (workload.kind) {
    case WorkloadKind::kTrace: return prepare_trace(workload, options, stop, prepared);
    case WorkloadKind::kFrameCache: return take_cache_file(workload.paths[0], prepared);
    case WorkloadKind::kImages: return prepare_images(workload, prepared);
    case WorkloadKind::kRun: return import_run(workload, study, options, prepared.record);
  }
  return {};
}

}  // namespace

PreparedWorkload prepare_workload(const Workload& workload, const StudyFile& study, const StudyOptions& options,
                                  const std::atomic<int>& stop) {
  PreparedWorkload prepared;
  WorkloadRecord& record = prepared.record;
  record.kind = name_of(workload.kind);
  record.source = workload.paths.size() == 1
                      ? workload.paths[0]
                      : std::filesystem::path(workload.paths[0]).parent_path().string();
  record.prepared = utc_now();
  record.host = host_name();
  record.version = TILEPRESS_VERSION;
  if (const auto done = prepare_any(workload, study, options, stop, prepared); !done) {
    record.state = done.error().kind == ErrorKind::kUnsupported ? "unsupported" : "failed";
    record.reason = done.error().text;
    // Errors name the input; the record holds it apart.
    if (record.reason.starts_with(record.source + ": ")) record.reason.erase(0, record.source.size() + 2);
  }
  return prepared;
}

}  // namespace tilepress
