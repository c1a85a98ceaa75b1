// Result store: names of files.
#include "result_store.h"

#include <cctype>
#include <cstring>

#include "study/configuration.h"
#include "tilepress/file_digest.h"

namespace tilepress {
namespace {

/// Goes up when equal frames and options get other rows or other columns.
constexpr const char* kResultsFormat = "tilepress results 1";
constexpr size_t kKeyDigits = 16, kLongestName = 100;

/// libcrypto without SHA-256 would be a broken machine; equal names for all would be worse than none.
std::string digest_of(const std::string& text) {
  auto digest = sha256_of_bytes(text);
  return digest ? *digest : "no-digest-" + std::to_string(std::hash<std::string>()(text));
}

/// "vdcp:fvc=16,policy=lru" as "vdcp_fvc=16_policy=lru".
std::string slug(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr(".-=", c) != nullptr ? c : '_';
  return out.substr(0, kLongestName);
}

std::string numbers_of_files(const SchemeSpec& spec) {
  std::string out;
  for (const auto& [key, value] : spec.values)
    if (const auto* numbers = std::get_if<std::vector<uint32_t>>(&value))
      for (const uint32_t number : *numbers) out.append(" ").append(std::to_string(number));
  return out;
}

}  // namespace

std::string ResultStore::result_key(const std::string& frames_digest, const SchemeSpec& spec) const {
  RunOptions options = options_;
  options.schemes = {spec};
  options.schemes[0].text = canonical_text(spec);
  return digest_of(std::string(kResultsFormat) + "\n" + frames_digest + "\n" + rows_fingerprint(options) + "\n" +
                   numbers_of_files(spec));
}

std::string ResultStore::result_path(const std::string& workload, const std::string& frames_digest,
                                     const SchemeSpec& spec) const {
  return folder_of(workload) + slug(canonical_text(spec)) + "-" +
         result_key(frames_digest, spec).substr(0, kKeyDigits) + ".csv";
}

std::string ResultStore::frames_key(const std::string& frames_digest, const std::string& further) const {
  RunOptions options;  // no scheme, tile or burst
  options.schemes.clear();
  options.frames = options_.frames;
  options.every = options_.every;
  return digest_of(std::string(kResultsFormat) + "\n" + frames_digest + "\n" + further + rows_fingerprint(options))
      .substr(0, kKeyDigits);
}

std::string ResultStore::bound_path(const std::string& workload, const std::string& frames_digest,
                                    const std::string& bound) const {
  const std::string further = bound + " burst=" + std::to_string(options_.model.burst_bits) + " ";
  return folder_of(workload) + bound + "-" + frames_key(frames_digest, further) + ".csv";
}

std::string ResultStore::frames_path(const std::string& workload, const std::string& frames_digest) const {
  return folder_of(workload) + "frames-" + metrics_key(frames_digest) + ".csv";
}

std::string ResultStore::colors_path(const std::string& workload, const std::string& frames_digest) const {
  return folder_of(workload) + "colors-" + metrics_key(frames_digest) + ".csv";
}

}  // namespace tilepress
