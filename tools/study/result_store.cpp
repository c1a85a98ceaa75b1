// Result store: names of files.
#include "result_store.h"

#include "report/html_text.h"
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

std::string numbers_of_files(const SchemeSpec& spec) {
  std::string out;
  for (const auto& [key, value] : spec.values)
    if (const auto* numbers = std::get_if<std::vector<uint32_t>>(&value))
      for (const uint32_t number : *numbers) out.append(" ").append(std::to_string(number));
  return out;
}

}  // namespace

std::string ResultStore::result_key(const SchemeSpec& spec) const {
  RunOptions options = options_;
  options.schemes = {spec};
  options.schemes[0].text = canonical_text(spec);
  return digest_of(std::string(kResultsFormat) + "\n" + frames_digest_ + "\n" + rows_fingerprint(options) +
                   "\n" + numbers_of_files(spec));
}

std::string ResultStore::result_path(const SchemeSpec& spec) const {
  const std::string slug = file_slug(canonical_text(spec), ".-=").substr(0, kLongestName);
  return folder_ + slug + "-" + result_key(spec).substr(0, kKeyDigits) + ".csv";
}

std::string ResultStore::frames_key(const std::string& further) const {
  RunOptions options;  // no scheme, tile or burst
  options.schemes.clear();
  options.frames = options_.frames;
  options.every = options_.every;
  return digest_of(std::string(kResultsFormat) + "\n" + frames_digest_ + "\n" + further +
                   rows_fingerprint(options))
      .substr(0, kKeyDigits);
}

std::string ResultStore::bound_path(const std::string& bound) const {
  const std::string further = bound + " burst=" + std::to_string(options_.model.burst_bits) + " ";
  return folder_ + bound + "-" + frames_key(further) + ".csv";
}

}  // namespace tilepress
