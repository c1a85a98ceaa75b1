// Trace file: text or bytes into a file, compressed as its suffix tells.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "streams/output_file.h"
#include "tilepress/result.h"

namespace tilepress {

/// A file of any length, written as it comes. The suffix .gz makes it gzip, .zst zstd. "-" is standard output,
/// not compressed. The file gets its name once it is whole. Errors begin with the path.
class TraceFile {
 public:
  TraceFile();
  ~TraceFile();
  Result<void> open(const std::string& path, bool replace);
  /// Appends to what will be written. commit() returns the first error.
  void write(std::string_view bytes);
  Result<void> commit();

  class Packer;

 private:
  std::string path_;
  OutputFile file_;
  std::unique_ptr<Packer> packer_;  ///< null: nothing is compressed
  bool failed_ = false;
};

}  // namespace tilepress
