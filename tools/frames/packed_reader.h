// Packed reader: reads .tpk files and checks everything they say.
#pragma once

#include <cstdint>
#include <fstream>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"

namespace tilepress {

/// Reads the surfaces of a file in any order. Error texts do not name the file.
class PackedFileReader {
 public:
  /// Checks every checksum, and that the file ends where it should: nothing is read of a damaged file. `in`
  /// is not owned.
  Result<void> open(std::istream& in);
  uint32_t count() const { return static_cast<uint32_t>(offsets_.size()); }
  /// Fails if the surface is damaged in a way that its checksums hide. Precondition: index < count().
  Result<void> read(uint32_t index, CompressedSurface& out);

 private:
  std::istream* in_ = nullptr;
  std::vector<uint64_t> offsets_;  ///< of each surface's header
};

/// A packed file on disk.
struct PackedFile {
  std::string path;
  std::ifstream stream;
  PackedFileReader reader;
};

/// Opens and checks the file. Error texts name the file.
Result<std::unique_ptr<PackedFile>> open_packed_file(const std::string& path);

}  // namespace tilepress
