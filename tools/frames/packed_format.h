// Packed format: what the writer and the reader of .tpk files share. codec/memory/README.md draws the format:
// little-endian fields, a CRC-32 after each header and each body.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

#include "frames/little_endian.h"

namespace tilepress {

constexpr uint32_t kPackedFileVersion = 1;
constexpr uint8_t kPackedMagic[8] = {0x89, 'T', 'P', 'K', '\r', '\n', 0x1A, '\n'};
constexpr uint32_t kFileHeaderBytes = 20;      ///< magic, version, count, CRC
constexpr uint32_t kSurfaceHeaderBytes = 56;   ///< without specification and CRC
constexpr uint32_t kSurfaceMark = 0x46525553;  ///< "SURF"
constexpr uint32_t kCrcBytes = 4;

inline uint32_t crc_of(const std::string& bytes, uint32_t crc = 0) {
  return static_cast<uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace tilepress
