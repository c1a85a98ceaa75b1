// Cache format: the index is read in one piece and checked before anything uses it.
#include "study/cache/cache_format.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "frames/little_endian.h"
#include "study/cache/file_bytes.h"
#include "tilepress/file_digest.h"

namespace tilepress {
namespace {

constexpr uint32_t kFormats = sizeof kFormatTraits / sizeof kFormatTraits[0];
constexpr uint32_t kCodings = 2;
constexpr uint64_t kMostPixels = uint64_t{1} << 28;  ///< as in image files
constexpr uint32_t kFlagKey = 1, kFlagWarmup = 2;
constexpr uint32_t kFooterFields = 24;  ///< bytes of the footer that the hash covers

Error damaged(std::string text) {
  return {ErrorKind::kBadBits, std::move(text)};
}
Error torn() {
  return damaged("is torn or no whole frame cache");
}

// The members of the origin, which is JSON.
constexpr std::pair<const char*, std::string CacheOrigin::*> kTexts[] = {
    {"key", &CacheOrigin::key},
    {"input", &CacheOrigin::input},
    {"input_sha256", &CacheOrigin::input_sha256},
    {"gl_vendor", &CacheOrigin::gl_vendor},
    {"gl_renderer", &CacheOrigin::gl_renderer},
    {"gl_version", &CacheOrigin::gl_version},
    {"retracer", &CacheOrigin::retracer},
    {"pixel_options", &CacheOrigin::pixel_options},
    {"frame_set", &CacheOrigin::frame_set},
    {"version", &CacheOrigin::version},
    {"rendered", &CacheOrigin::rendered},
    {"reason", &CacheOrigin::reason},
};
constexpr std::pair<const char*, uint64_t CacheOrigin::*> kCounts[] = {
    {"expected_frames", &CacheOrigin::expected_frames},
    {"unsupported_frames", &CacheOrigin::unsupported_frames},
};

std::string origin_text(const CacheOrigin& origin) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, member] : kTexts) json[name] = origin.*member;
  for (const auto& [name, member] : kCounts) json[name] = origin.*member;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Unknown members are skipped, missing ones stay empty. Error: kBadBits.
Result<CacheOrigin> parse_origin(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::kBadBits, "the origin is no JSON object"};
  CacheOrigin origin;
  for (const auto& [name, member] : kTexts)
    if (const auto found = json.find(name); found != json.end() && found->is_string())
      origin.*member = found->get<std::string>();
  for (const auto& [name, member] : kCounts)
    if (const auto found = json.find(name); found != json.end() && found->is_number_unsigned())
      origin.*member = found->get<uint64_t>();
  return origin;
}

/// What the digest of all frames is computed over.
void put_identity(std::string& out, const CacheEntry& entry) {
  put_field(out, entry.frame.surface, 4);
  put_field(out, entry.frame.width, 4);
  put_field(out, entry.frame.height, 4);
  put_field(out, static_cast<uint32_t>(entry.frame.format), 1);
  put_field(out, entry.frame.warmup ? 1 : 0, 1);
  put_field(out, entry.frame.frame, 8);
  for (const uint64_t word : entry.pixel_hash) put_field(out, word, 8);
}

void put_entry(std::string& out, const CacheEntry& entry) {
  const CachedFrame& frame = entry.frame;
  put_field(out, frame.surface, 4);
  put_field(out, frame.width, 4);
  put_field(out, frame.height, 4);
  put_field(out, static_cast<uint32_t>(frame.format), 1);
  put_field(out, static_cast<uint32_t>(entry.coding), 1);
  put_field(out, (entry.key ? kFlagKey : 0) | (frame.warmup ? kFlagWarmup : 0), 2);
  for (const uint64_t value :
       {frame.frame, frame.time_ns, frame.readback_ns, entry.offset, entry.stored_bytes, entry.stored_hash,
        entry.pixel_hash[0], entry.pixel_hash[1]})
    put_field(out, value, 8);
}

Result<CacheEntry> take_entry(Fields& fields, uint64_t frames_end) {
  CacheEntry entry;
  CachedFrame& frame = entry.frame;
  frame.surface = fields.take4();
  frame.width = fields.take4();
  frame.height = fields.take4();
  const uint64_t format = fields.take(1), coding = fields.take(1), flags = fields.take(2);
  for (uint64_t* value :
       {&frame.frame, &frame.time_ns, &frame.readback_ns, &entry.offset, &entry.stored_bytes,
        &entry.stored_hash, &entry.pixel_hash[0], &entry.pixel_hash[1]})
    *value = fields.take(8);
  if (format >= kFormats || coding >= kCodings || flags > (kFlagKey | kFlagWarmup))
    return damaged("a frame of an unknown format or coding");
  frame.format = static_cast<PixelFormat>(format);
  entry.coding = static_cast<FrameCoding>(coding);
  entry.key = (flags & kFlagKey) != 0;
  frame.warmup = (flags & kFlagWarmup) != 0;
  if (frame.width < 1 || frame.height < 1 || frame.width > kMaxSurfaceSide ||
      frame.height > kMaxSurfaceSide || uint64_t{frame.width} * frame.height > kMostPixels)
    return damaged("a frame of an impossible size");
  if (entry.offset < kCacheHeaderBytes || entry.offset > frames_end ||
      entry.stored_bytes > frames_end - entry.offset)
    return damaged("a frame outside the file");
  return entry;
}

/// Checks that each frame has what it depends on.
Result<void> check_order(const std::vector<CacheEntry>& entries) {
  std::map<uint32_t, const CachedFrame*> last;
  for (const CacheEntry& entry : entries) {
    const CachedFrame& frame = entry.frame;
    const auto [before, first] = last.emplace(frame.surface, &frame);
    if (first ? !entry.key
              : before->second->frame >= frame.frame || before->second->width != frame.width ||
                    before->second->height != frame.height || before->second->format != frame.format)
      return damaged("frames of a surface that do not follow each other");
    before->second = &frame;
  }
  return {};
}

Result<void> check_header(int fd) {
  std::string header(kCacheHeaderBytes, '\0');
  if (!read_at(fd, 0, std::as_writable_bytes(std::span(header))))
    return Error{ErrorKind::kUnsupported, "is no frame cache"};
  if (!begins_as_frame_cache(bytes_of(header))) return Error{ErrorKind::kUnsupported, "is no frame cache"};
  const uint32_t version = Fields(std::string_view(header).substr(kFrameCacheMagicBytes)).take4();
  if (version == kFrameCacheVersion) return {};
  return Error{ErrorKind::kUnsupported, "is a frame cache of format " + std::to_string(version) +
                                            "; this version reads format " +
                                            std::to_string(kFrameCacheVersion)};
}

}  // namespace

uint64_t hash_of(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::array<uint64_t, 2> wide_hash_of(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

bool begins_as_frame_cache(std::span<const std::byte> start) {
  return start.size() >= sizeof kFrameCacheMagic &&
         std::memcmp(start.data(), kFrameCacheMagic, sizeof kFrameCacheMagic) == 0;
}

std::string cache_header() {
  std::string header(reinterpret_cast<const char*>(kFrameCacheMagic), sizeof kFrameCacheMagic);
  put_field(header, kFrameCacheVersion, 4);
  put_field(header, 0, 4);
  return header;
}

std::string cache_tail(const CacheOrigin& origin, const std::vector<CacheEntry>& entries, uint64_t offset) {
  std::string tail;
  for (const CacheEntry& entry : entries) put_entry(tail, entry);
  const std::string text = origin_text(origin);
  tail += text;
  put_field(tail, offset, 8);
  put_field(tail, entries.size(), 8);
  put_field(tail, text.size(), 8);
  put_field(tail, hash_of(bytes_of(tail)), 8);
  put_field(tail, offset + tail.size() + 16, 8);
  tail.append(reinterpret_cast<const char*>(kFrameCacheEnd), sizeof kFrameCacheEnd);
  return tail;
}

Result<CacheIndex> read_cache_index(int fd) {
  if (const auto checked = check_header(fd); !checked) return checked.error();
  struct stat status {};
  if (fstat(fd, &status) != 0) return Error{ErrorKind::kFile, std::strerror(errno)};
  CacheIndex index;
  const auto whole_bytes = static_cast<uint64_t>(status.st_size);
  if (whole_bytes < kCacheHeaderBytes + kCacheFooterBytes) return torn();
  std::string footer(kCacheFooterBytes, '\0');
  const uint64_t footer_at = whole_bytes - kCacheFooterBytes;
  if (!read_at(fd, footer_at, std::as_writable_bytes(std::span(footer))))
    return Error{ErrorKind::kFile, std::strerror(errno)};
  if (std::memcmp(&footer[kCacheFooterBytes - sizeof kFrameCacheEnd], kFrameCacheEnd,
                  sizeof kFrameCacheEnd) != 0)
    return torn();
  Fields fields(footer);
  const uint64_t offset = fields.take(8), count = fields.take(8), origin_bytes = fields.take(8);
  const uint64_t hash = fields.take(8), file_bytes = fields.take(8);
  if (file_bytes != whole_bytes || offset < kCacheHeaderBytes || offset > footer_at ||
      count > (footer_at - offset) / kCacheEntryBytes ||
      origin_bytes != footer_at - offset - count * kCacheEntryBytes)
    return torn();
  std::string tail(footer_at - offset + kFooterFields, '\0');
  if (!read_at(fd, offset, std::as_writable_bytes(std::span(tail))))
    return Error{ErrorKind::kFile, std::strerror(errno)};
  if (hash_of(bytes_of(tail)) != hash) return damaged("the index is damaged");
  Fields table(tail);
  std::string identity;
  for (uint64_t i = 0; i < count; ++i) {
    const auto entry = take_entry(table, offset);
    if (!entry) return entry.error();
    put_identity(identity, *entry);
    index.entries.push_back(*entry);
  }
  if (const auto checked = check_order(index.entries); !checked) return checked.error();
  const auto origin = parse_origin(std::string_view(tail).substr(count * kCacheEntryBytes, origin_bytes));
  if (!origin) return origin.error();
  const auto digest = sha256_of_bytes(identity);
  if (!digest) return digest.error();
  index.origin = *origin;
  index.frames_digest = *digest;
  return index;
}

}  // namespace tilepress
