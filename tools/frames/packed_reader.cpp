// Packed reader: no size that a header claims is trusted before the file has room for it.
#include "frames/packed_reader.h"

#include <algorithm>
#include <cstring>
#include <istream>

#include "frames/packed_format.h"

namespace tilepress {
namespace {

constexpr uint32_t kMaxSpecBytes = 4096;

Error bad(std::string text) {
  return {ErrorKind::kBadBits, std::move(text)};
}
Error unreadable() {
  return {ErrorKind::kFile, "cannot be read"};
}

/// Fuzzing skips the checksums: random bytes would get no further.
bool same_crc(uint64_t stored, uint32_t computed) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return stored == computed || true;
#else
  return stored == computed;
#endif
}

bool read_bytes(std::istream& in, uint64_t offset, uint64_t size, std::string& out) {
  out.resize(size);
  in.clear();
  in.seekg(static_cast<std::streamoff>(offset));
  return size == 0 || static_cast<bool>(in.read(out.data(), static_cast<std::streamsize>(size)));
}

bool read_into(std::istream& in, std::vector<uint8_t>& out, uint64_t size) {
  out.resize(size);
  return size == 0 ||
         static_cast<bool>(in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(size)));
}

/// The size of the stream, or nothing if it has none.
Result<uint64_t> size_of(std::istream& in) {
  in.clear();
  in.seekg(0, std::ios::end);
  const auto end = static_cast<std::streamoff>(in.tellg());
  if (!in || end < 0) return unreadable();
  return static_cast<uint64_t>(end);
}

/// Where the body of a surface lies.
struct SurfaceExtent {
  uint64_t body_offset = 0, body_bytes = 0;  ///< without the CRC after it
  uint64_t payload_bytes = 0;
  uint64_t next() const { return body_offset + body_bytes + kCrcBytes; }
};

/// Takes the pixel format and the scheme.
Result<void> take_kinds(uint32_t format, const std::string& spec, CompressedSurface& out) {
  if (format >= std::size(kFormatTraits)) return bad("unknown pixel format " + std::to_string(format));
  out.format = static_cast<PixelFormat>(format);
  // The file name of a palette may hold spaces and UTF-8, but no control characters.
  if (std::any_of(spec.begin(), spec.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }))
    return bad("a scheme specification that is no text");
  const auto scheme = parse_scheme(spec, SchemeFiles::kLeave);
  if (!scheme) return bad(scheme.error().text);
  out.scheme = *scheme;
  return {};
}

/// Reads and checks the header at `offset` of a file of `file_bytes`.
Result<SurfaceExtent> read_surface_header(std::istream& in, uint64_t offset, uint64_t file_bytes,
                                          CompressedSurface& out) {
  if (file_bytes < offset || file_bytes - offset < kSurfaceHeaderBytes) return bad("cut short in a header");
  std::string header, spec;
  if (!read_bytes(in, offset, kSurfaceHeaderBytes, header)) return unreadable();
  Fields fields(header);
  if (fields.take4() != kSurfaceMark) return bad("no surface header where one should be");
  out.ordinal = fields.take(8);
  out.width = fields.take4();
  out.height = fields.take4();
  const uint32_t format = fields.take4();
  out.tile_side = fields.take4();
  out.burst_bits = fields.take4();
  out.csb_bits = fields.take4();
  out.table_bits = fields.take(8);
  SurfaceExtent extent;
  extent.payload_bytes = fields.take(8);
  const uint32_t spec_bytes = fields.take4();
  if (spec_bytes > kMaxSpecBytes) return bad("damaged surface header");
  if (file_bytes - offset - kSurfaceHeaderBytes < spec_bytes + kCrcBytes) return bad("cut short in a header");
  if (!read_bytes(in, offset + kSurfaceHeaderBytes, spec_bytes + kCrcBytes, spec)) return unreadable();
  const std::string crc_field = spec.substr(spec_bytes);
  spec.resize(spec_bytes);
  if (!same_crc(Fields(crc_field).take4(), crc_of(spec, crc_of(header))))
    return bad("damaged surface header (checksum)");
  if (const auto taken = take_kinds(format, spec, out); !taken) return taken.error();
  if (const auto possible = out.possible(); !possible) return possible.error();

  extent.body_offset = offset + kSurfaceHeaderBytes + spec_bytes + kCrcBytes;
  const uint64_t room = file_bytes - extent.body_offset;
  if (out.table_bits / 8 > room || extent.payload_bytes > room)
    return bad("cut short, or a header that claims too much");
  extent.body_bytes =
      (out.table_bits + 7) / 8 + (out.csb_plane_bits() + 7) / 8 + 2 * out.blocks() + extent.payload_bytes;
  if (room < kCrcBytes || extent.body_bytes > room - kCrcBytes) return bad("cut short in a surface");
  return extent;
}

Result<void> check_body(std::istream& in, const SurfaceExtent& extent) {
  constexpr uint64_t kPieceBytes = 1 << 18;
  uint32_t crc = 0;
  std::string piece;
  for (uint64_t done = 0; done < extent.body_bytes; done += piece.size()) {
    const uint64_t size = std::min(extent.body_bytes - done, kPieceBytes);
    if (!read_bytes(in, extent.body_offset + done, size, piece)) return unreadable();
    crc = crc_of(piece, crc);
  }
  if (!read_bytes(in, extent.body_offset + extent.body_bytes, kCrcBytes, piece) ||
      !same_crc(Fields(piece).take4(), crc))
    return bad("damaged (checksum)");
  return {};
}

/// Checks the file header. Returns the number of surfaces.
Result<uint32_t> read_file_header(std::istream& in, uint64_t file_bytes) {
  std::string header;
  if (!read_bytes(in, 0, std::min<uint64_t>(file_bytes, kFileHeaderBytes), header)) return unreadable();
  if (std::memcmp(header.data(), kPackedMagic, std::min(header.size(), sizeof kPackedMagic)) != 0)
    return bad("not a packed file");
  if (header.empty()) return bad("empty, not a packed file");
  if (header.size() < kFileHeaderBytes) return bad("cut short in the file header");
  Fields fields(header);
  fields.take(sizeof kPackedMagic);
  const uint32_t version = fields.take4(), count = fields.take4(), crc = fields.take4();
  header.resize(kFileHeaderBytes - kCrcBytes);
  if (!same_crc(crc, crc_of(header))) return bad("damaged file header (checksum)");
  if (version != kPackedFileVersion)
    return Error{ErrorKind::kUnsupported, "version " + std::to_string(version) +
                                              ", this tilepress reads version " +
                                              std::to_string(kPackedFileVersion)};
  return count;
}

/// Reads the body that `header` describes.
Result<void> read_body(std::istream& in, const SurfaceExtent& extent, CompressedSurface& out) {
  in.seekg(static_cast<std::streamoff>(extent.body_offset));
  std::vector<uint8_t> sizes;
  if (!read_into(in, out.tables, (out.table_bits + 7) / 8) ||
      !read_into(in, out.csb, (out.csb_plane_bits() + 7) / 8) || !read_into(in, sizes, 2 * out.blocks()))
    return unreadable();
  out.block_bits.resize(out.blocks());
  uint64_t payload_bytes = 0;
  for (size_t i = 0; i < out.block_bits.size(); ++i) {
    out.block_bits[i] = static_cast<uint16_t>(sizes[2 * i] | sizes[2 * i + 1] << 8);
    if (out.block_bits[i] > out.raw_block_bits()) return bad("a block larger than a raw one");
    payload_bytes += (out.block_bits[i] + 7u) / 8;
  }
  if (payload_bytes != extent.payload_bytes) return bad("block sizes that do not fit the payload");
  out.payload.assign(out.blocks() * out.slot_bytes(), 0);
  for (size_t i = 0; i < out.block_bits.size(); ++i) {
    const auto bytes = static_cast<std::streamsize>((out.block_bits[i] + 7u) / 8);
    if (!in.read(reinterpret_cast<char*>(out.payload.data() + i * out.slot_bytes()), bytes))
      return unreadable();
  }
  return out.consistent();
}

}  // namespace

Result<void> PackedFileReader::open(std::istream& in) {
  in_ = &in;
  offsets_.clear();
  const auto file_bytes = size_of(in);
  if (!file_bytes) return file_bytes.error();
  const auto count = read_file_header(in, *file_bytes);
  if (!count) return count.error();
  uint64_t offset = kFileHeaderBytes;
  for (uint32_t i = 0; i < *count; ++i) {
    const std::string where = "surface " + std::to_string(i);
    if (offset == *file_bytes)
      return bad("cut short: " + std::to_string(i) + " of " + std::to_string(*count) + " surfaces");
    CompressedSurface surface;
    const auto extent = read_surface_header(in, offset, *file_bytes, surface);
    if (!extent) return about(where, extent.error());
    if (const auto checked = check_body(in, *extent); !checked) return about(where, checked.error());
    offsets_.push_back(offset);
    offset = extent->next();
  }
  if (offset != *file_bytes)
    return bad(std::to_string(*file_bytes - offset) + " bytes too many behind the last surface");
  return {};
}

Result<void> PackedFileReader::read(uint32_t index, CompressedSurface& out) {
  const std::string where = "surface " + std::to_string(index);
  const auto file_bytes = size_of(*in_);
  if (!file_bytes) return about(where, file_bytes.error());
  const auto extent = read_surface_header(*in_, offsets_[index], *file_bytes, out);
  if (!extent) return about(where, extent.error());
  const auto done = read_body(*in_, *extent, out);
  if (!done) return about(where, done.error());
  return {};
}

}  // namespace tilepress
