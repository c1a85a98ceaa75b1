// Packed file: little-endian fields, a CRC-32 behind each header and each body.
#include "frames/packed_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <istream>
#include <ostream>

namespace tilepress {
namespace {

constexpr uint8_t kMagic[8] = {0x89, 'T', 'P', 'K', '\r', '\n', 0x1A, '\n'};
constexpr uint32_t kFileHeaderBytes = 20;      // magic, version, count, CRC
constexpr uint32_t kSurfaceHeaderBytes = 56;   // without specification and CRC
constexpr uint32_t kSurfaceMark = 0x46525553;  // "SURF"
constexpr uint32_t kMaxSpecBytes = 4096;
constexpr uint32_t kCrcBytes = 4;

void put(std::string& out, uint64_t value, uint32_t bytes) {
  for (uint32_t i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

uint32_t crc_of(const void* bytes, size_t size, uint32_t crc = 0) {
  return static_cast<uint32_t>(crc32_z(crc, static_cast<const Bytef*>(bytes), size));
}

/// Fuzzing goes past the checksums: random bytes would get no further.
bool same_crc(uint64_t stored, uint32_t computed) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return stored == computed || true;
#else
  return stored == computed;
#endif
}

std::string file_header(uint32_t count) {
  std::string header(reinterpret_cast<const char*>(kMagic), sizeof kMagic);
  put(header, kPackedFileVersion, 4);
  put(header, count, 4);
  put(header, crc_of(header.data(), header.size()), 4);
  return header;
}

/// Takes little-endian fields off a buffer that is long enough.
class Fields {
 public:
  explicit Fields(const std::string& bytes) : at_(reinterpret_cast<const uint8_t*>(bytes.data())) {}
  uint64_t take(uint32_t bytes) {
    uint64_t value = 0;
    for (uint32_t i = 0; i < bytes; ++i) value |= uint64_t{*at_++} << (8 * i);
    return value;
  }

 private:
  const uint8_t* at_;
};

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

/// What a surface header leads to.
struct SurfaceExtent {
  uint64_t body_offset = 0, body_bytes = 0;  ///< without the CRC behind it
  uint64_t payload_bytes = 0;
  uint64_t next() const { return body_offset + body_bytes + kCrcBytes; }
};

/// Reads and checks the header at `offset` of a file of `file_bytes`.
bool read_surface_header(std::istream& in, uint64_t offset, uint64_t file_bytes, CompressedSurface& out,
                         SurfaceExtent& extent, std::string& error) {
  const auto fail = [&](std::string reason) {
    error = std::move(reason);
    return false;
  };
  if (file_bytes < offset || file_bytes - offset < kSurfaceHeaderBytes) return fail("cut short in a header");
  std::string bytes;
  if (!read_bytes(in, offset, kSurfaceHeaderBytes, bytes)) return fail("cannot be read");
  Fields fields(bytes);
  if (fields.take(4) != kSurfaceMark) return fail("no surface header where one should be");
  out.ordinal = fields.take(8);
  out.width = static_cast<uint32_t>(fields.take(4));
  out.height = static_cast<uint32_t>(fields.take(4));
  const auto format = static_cast<uint32_t>(fields.take(4));
  out.tile_side = static_cast<uint32_t>(fields.take(4));
  out.burst_bits = static_cast<uint32_t>(fields.take(4));
  out.csb_bits = static_cast<uint32_t>(fields.take(4));
  out.table_bits = fields.take(8);
  extent.payload_bytes = fields.take(8);
  const auto spec_bytes = static_cast<uint32_t>(fields.take(4));
  const uint64_t left = file_bytes - offset - kSurfaceHeaderBytes;
  if (spec_bytes > kMaxSpecBytes) return fail("damaged surface header");
  if (left < spec_bytes + kCrcBytes) return fail("cut short in a header");
  std::string spec;
  if (!read_bytes(in, offset + kSurfaceHeaderBytes, spec_bytes + kCrcBytes, spec))
    return fail("cannot be read");
  const std::string crc_field = spec.substr(spec_bytes);
  spec.resize(spec_bytes);
  if (!same_crc(Fields(crc_field).take(4),
                crc_of(spec.data(), spec.size(), crc_of(bytes.data(), bytes.size()))))
    return fail("damaged surface header (checksum)");

  if (format >= std::size(kFormatTraits)) return fail("unknown pixel format " + std::to_string(format));
  out.format = static_cast<PixelFormat>(format);
  // A palette's file name may hold spaces and UTF-8; what moves a terminal's cursor may not be in it.
  if (std::any_of(spec.begin(), spec.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }))
    return fail("a scheme specification that is no text");
  const auto scheme = parse_scheme(spec, SchemeFiles::kLeave);
  if (!scheme) {
    error = scheme.error().text;
    return false;
  }
  out.scheme = *scheme;
  extent.body_offset = offset + kSurfaceHeaderBytes + spec_bytes + kCrcBytes;
  const uint64_t room = file_bytes - extent.body_offset;
  if (const auto checked = out.possible(); !checked) {
    error = checked.error().text;
    return false;
  }
  if (out.table_bits / 8 > room || extent.payload_bytes > room)
    return fail("cut short, or a header that claims too much");
  extent.body_bytes =
      (out.table_bits + 7) / 8 + (out.csb_plane_bits() + 7) / 8 + 2 * out.blocks() + extent.payload_bytes;
  if (room < kCrcBytes || extent.body_bytes > room - kCrcBytes) return fail("cut short in a surface");
  return true;
}

}  // namespace

PackedFileWriter::PackedFileWriter(std::ostream& out) : out_(out) {
  const std::string header = file_header(0);
  out_.write(header.data(), static_cast<std::streamsize>(header.size()));
}

bool PackedFileWriter::append(const CompressedSurface& surface) {
  std::string body(reinterpret_cast<const char*>(surface.tables.data()), surface.tables.size());
  body.append(reinterpret_cast<const char*>(surface.csb.data()), surface.csb.size());
  uint64_t payload_bytes = 0;
  for (const uint16_t bits : surface.block_bits) {
    put(body, bits, 2);
    payload_bytes += (bits + 7u) / 8;
  }
  body.reserve(body.size() + payload_bytes);
  for (uint64_t i = 0; i < surface.block_bits.size(); ++i)
    body.append(reinterpret_cast<const char*>(surface.payload.data() + i * surface.slot_bytes()),
                (surface.block_bits[i] + 7u) / 8);

  std::string header;
  put(header, kSurfaceMark, 4);
  put(header, surface.ordinal, 8);
  put(header, surface.width, 4);
  put(header, surface.height, 4);
  put(header, static_cast<uint32_t>(surface.format), 4);
  put(header, surface.tile_side, 4);
  put(header, surface.burst_bits, 4);
  put(header, surface.csb_bits, 4);
  put(header, surface.table_bits, 8);
  put(header, payload_bytes, 8);
  put(header, surface.scheme.text.size(), 4);
  header += surface.scheme.text;
  put(header, crc_of(header.data(), header.size()), 4);
  put(body, crc_of(body.data(), body.size()), 4);
  out_.write(header.data(), static_cast<std::streamsize>(header.size()));
  out_.write(body.data(), static_cast<std::streamsize>(body.size()));
  ++count_;
  return static_cast<bool>(out_);
}

bool PackedFileWriter::finish() {
  out_.seekp(0);
  const std::string header = file_header(count_);
  out_.write(header.data(), static_cast<std::streamsize>(header.size()));
  out_.flush();
  return static_cast<bool>(out_);
}

bool PackedFileReader::open(std::istream& in, std::string& error) {
  in_ = &in;
  offsets_.clear();
  const auto fail = [&](std::string reason) {
    error = std::move(reason);
    return false;
  };
  in.clear();
  in.seekg(0, std::ios::end);
  const auto end = static_cast<std::streamoff>(in.tellg());
  if (!in || end < 0) return fail("cannot be read");
  const auto file_bytes = static_cast<uint64_t>(end);
  std::string header;
  if (!read_bytes(in, 0, std::min<uint64_t>(file_bytes, kFileHeaderBytes), header))
    return fail("cannot be read");
  if (std::memcmp(header.data(), kMagic, std::min(header.size(), sizeof kMagic)) != 0)
    return fail("not a packed file");
  if (header.size() < kFileHeaderBytes)
    return fail(header.empty() ? "empty, not a packed file" : "cut short in the file header");
  Fields fields(header);
  fields.take(8);
  const auto version = static_cast<uint32_t>(fields.take(4));
  const auto count = static_cast<uint32_t>(fields.take(4));
  if (!same_crc(fields.take(4), crc_of(header.data(), kFileHeaderBytes - kCrcBytes)))
    return fail("damaged file header (checksum)");
  if (version != kPackedFileVersion)
    return fail("version " + std::to_string(version) + ", this tilepress reads version " +
                std::to_string(kPackedFileVersion));

  uint64_t offset = kFileHeaderBytes;
  for (uint32_t i = 0; i < count; ++i) {
    const std::string where = "surface " + std::to_string(i) + ": ";
    CompressedSurface surface;
    SurfaceExtent extent;
    if (offset == file_bytes)
      return fail("cut short: " + std::to_string(i) + " of " + std::to_string(count) + " surfaces");
    if (!read_surface_header(in, offset, file_bytes, surface, extent, error)) return fail(where + error);
    uint32_t crc = 0;
    std::string piece;
    for (uint64_t done = 0; done < extent.body_bytes; done += piece.size()) {
      const uint64_t size = std::min<uint64_t>(extent.body_bytes - done, 1 << 18);
      if (!read_bytes(in, extent.body_offset + done, size, piece)) return fail(where + "cannot be read");
      crc = crc_of(piece.data(), piece.size(), crc);
    }
    if (!read_bytes(in, extent.body_offset + extent.body_bytes, kCrcBytes, piece) ||
        !same_crc(Fields(piece).take(4), crc))
      return fail(where + "damaged (checksum)");
    offsets_.push_back(offset);
    offset = extent.next();
  }
  if (offset != file_bytes)
    return fail(std::to_string(file_bytes - offset) + " bytes too many behind the last surface");
  return true;
}

bool PackedFileReader::read(uint32_t index, CompressedSurface& out, std::string& error) {
  const auto fail = [&](const std::string& reason) {
    error = "surface " + std::to_string(index) + ": " + reason;
    return false;
  };
  in_->clear();
  in_->seekg(0, std::ios::end);
  const auto file_bytes = static_cast<uint64_t>(static_cast<std::streamoff>(in_->tellg()));
  SurfaceExtent extent;
  if (!read_surface_header(*in_, offsets_[index], file_bytes, out, extent, error)) return fail(error);
  in_->seekg(static_cast<std::streamoff>(extent.body_offset));
  std::vector<uint8_t> sizes;
  if (!read_into(*in_, out.tables, (out.table_bits + 7) / 8) ||
      !read_into(*in_, out.csb, (out.csb_plane_bits() + 7) / 8) || !read_into(*in_, sizes, 2 * out.blocks()))
    return fail("cannot be read");
  out.block_bits.resize(out.blocks());
  uint64_t payload_bytes = 0;
  for (size_t i = 0; i < out.block_bits.size(); ++i) {
    out.block_bits[i] = static_cast<uint16_t>(sizes[2 * i] | sizes[2 * i + 1] << 8);
    if (out.block_bits[i] > out.raw_block_bits()) return fail("a block larger than a raw one");
    payload_bytes += (out.block_bits[i] + 7u) / 8;
  }
  if (payload_bytes != extent.payload_bytes) return fail("block sizes that do not fit the payload");
  out.payload.assign(out.blocks() * out.slot_bytes(), 0);
  for (size_t i = 0; i < out.block_bits.size(); ++i) {
    const auto bytes = static_cast<std::streamsize>((out.block_bits[i] + 7u) / 8);
    if (!in_->read(reinterpret_cast<char*>(out.payload.data() + i * out.slot_bytes()), bytes))
      return fail("cannot be read");
  }
  const auto checked = out.consistent();
  return checked ? true : fail(checked.error().text);
}

}  // namespace tilepress
