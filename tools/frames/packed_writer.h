// Packed writer: writes compressed surfaces to a .tpk file.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "tilepress/compressed_surface.h"

namespace tilepress {

/// Writes surfaces one after the other. The stream must be seekable: finish() writes the count into the file
/// header. Error texts do not name the file.
class PackedFileWriter {
 public:
  explicit PackedFileWriter(std::ostream& out);
  Result<void> append(const CompressedSurface& surface);
  Result<void> finish();
  uint32_t count() const { return count_; }

 private:
  std::ostream& out_;
  uint32_t count_ = 0;
};

}  // namespace tilepress
