// Packed file: a sequence of compressed surfaces as a .tpk file (codec/memory/README.md draws it).
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"

namespace tilepress {

constexpr uint32_t kPackedFileVersion = 1;

/// Writes surfaces one after the other. The stream must be seekable: finish() writes the count into the
/// file header.
class PackedFileWriter {
 public:
  explicit PackedFileWriter(std::ostream& out);
  /// False when the stream takes no more.
  bool append(const CompressedSurface& surface);
  bool finish();

 private:
  std::ostream& out_;
  uint32_t count_ = 0;
};

/// Reads a file, checking everything it says. No output of a damaged file is ever seen: open() verifies each
/// checksum and that the file ends where it should.
class PackedFileReader {
 public:
  /// False and one line in `error` if the stream holds no whole packed file. `in` is not owned.
  bool open(std::istream& in, std::string& error);
  uint32_t count() const { return static_cast<uint32_t>(offsets_.size()); }
  /// False and one line in `error`: the surface is damaged in a way its checksums hide.
  /// Precondition: index < count().
  bool read(uint32_t index, CompressedSurface& out, std::string& error);

 private:
  std::istream* in_ = nullptr;
  std::vector<uint64_t> offsets_;  ///< of each surface's header
};

}  // namespace tilepress
