// Packed writer: the body of a surface has no empty bytes between its blocks.
#include "frames/packed_writer.h"

#include <cerrno>
#include <cstring>
#include <ostream>

#include "frames/packed_format.h"

namespace tilepress {
namespace {

void write(std::ostream& out, const std::string& bytes) {
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Result<void> state_of(const std::ostream& out) {
  if (!out) return Error{ErrorKind::kFile, std::strerror(errno)};
  return {};
}

std::string file_header(uint32_t count) {
  std::string header(reinterpret_cast<const char*>(kPackedMagic), sizeof kPackedMagic);
  put_field(header, kPackedFileVersion, 4);
  put_field(header, count, 4);
  put_field(header, crc_of(header), 4);
  return header;
}

}  // namespace

PackedFileWriter::PackedFileWriter(std::ostream& out) : out_(out) {
  write(out_, file_header(0));
}

Result<void> PackedFileWriter::append(const CompressedSurface& surface) {
  std::string body(reinterpret_cast<const char*>(surface.tables.data()), surface.tables.size());
  body.append(reinterpret_cast<const char*>(surface.csb.data()), surface.csb.size());
  uint64_t payload_bytes = 0;
  for (const uint16_t bits : surface.block_bits) {
    put_field(body, bits, 2);
    payload_bytes += (bits + 7u) / 8;
  }
  body.reserve(body.size() + payload_bytes + kCrcBytes);
  for (uint64_t i = 0; i < surface.block_bits.size(); ++i)
    body.append(reinterpret_cast<const char*>(surface.payload.data() + i * surface.slot_bytes()),
                (surface.block_bits[i] + 7u) / 8);
  put_field(body, crc_of(body), 4);

  std::string header;
  put_field(header, kSurfaceMark, 4);
  put_field(header, surface.ordinal, 8);
  put_field(header, surface.width, 4);
  put_field(header, surface.height, 4);
  put_field(header, static_cast<uint32_t>(surface.format), 4);
  put_field(header, surface.tile_side, 4);
  put_field(header, surface.burst_bits, 4);
  put_field(header, surface.csb_bits, 4);
  put_field(header, surface.table_bits, 8);
  put_field(header, payload_bytes, 8);
  put_field(header, surface.scheme.text.size(), 4);
  header += surface.scheme.text;
  put_field(header, crc_of(header), 4);
  write(out_, header);
  write(out_, body);
  ++count_;
  return state_of(out_);
}

Result<void> PackedFileWriter::finish() {
  out_.seekp(0);
  write(out_, file_header(count_));
  out_.flush();
  return state_of(out_);
}

}  // namespace tilepress
