// Input kind: signatures of this program's files, of traces and of images.
#include "input_kind.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <span>

#include "frames/packed_format.h"
#include "images/image_kind.h"
#include "study/cache/frame_cache.h"
#include "tilepress/run_reader.h"
#include "tilepress/trace_summary.h"

namespace tilepress {

namespace fs = std::filesystem;

namespace {

struct InputKind {
  std::string_view verb, words;
};

InputKind kind_of_file(const fs::path& path) {
  if (begins_as_trace(path)) return {"replay", "traces"};
  std::string start(kImageKindBytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<size_t>(file.gcount()));
  if (begins_as_frame_cache(std::as_bytes(std::span(start)))) return {"frames", "frame caches"};
  if (start.starts_with(std::string_view(reinterpret_cast<const char*>(kPackedMagic), sizeof kPackedMagic)))
    return {"unpack", "packed files"};
  const ImageReader reader = image_kind(start).reader;
  if (reader == ImageReader::kMovie || reader == ImageReader::kRefused) return {};
  return {"frames", "images"};
}

InputKind kind_of(const fs::path& path) {
  std::error_code code;
  if (fs::is_regular_file(path, code)) return kind_of_file(path);
  if (holds_run(path)) return {"report", "runs"};
  std::set<fs::path> files;
  for (auto entry = fs::directory_iterator(path, code); !code && entry != fs::directory_iterator();
       entry.increment(code))
    if (std::error_code kind; entry->is_regular_file(kind)) files.insert(entry->path());
  for (const fs::path& file : files)
    if (const InputKind kind = kind_of_file(file); !kind.verb.empty()) return kind;
  return {};
}

}  // namespace

std::string verb_hint(const std::string& path, std::string_view own) {
  const auto [verb, words] = kind_of(path);
  if (verb.empty() || verb == own) return {};
  return std::string("; tilepress ").append(verb).append(" takes ").append(words);
}

}  // namespace tilepress
