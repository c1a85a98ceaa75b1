// File digest: SHA-256 of a file, by which traces are told apart.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tilepress {

/// SHA-256 (FIPS 180-4), fed piece by piece.
class Sha256 {
 public:
  void add(std::span<const uint8_t> bytes);
  /// The digest in lower-case hexadecimal, 64 characters. Nothing may be added afterwards.
  std::string finish();

 private:
  void mix(const uint8_t* block);
  std::array<uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                    0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<uint8_t, 64> block_{};
  uint64_t length_bytes_ = 0;
};

/// Nothing and one line in `error` if the file cannot be read.
std::optional<std::string> sha256_of_file(const std::string& path, std::string& error);

}  // namespace tilepress
