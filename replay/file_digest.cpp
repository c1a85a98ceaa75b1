// File digest: SHA-256 by OpenSSL's libcrypto.
#include "tilepress/file_digest.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace tilepress {
namespace {

std::string hexadecimal(const unsigned char* bytes, size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    text += "0123456789abcdef"[bytes[i] >> 4];
    text += "0123456789abcdef"[bytes[i] & 15];
  }
  return text;
}

}  // namespace

std::optional<std::string> sha256_of_file(const std::string& path, std::string& error) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    error = std::strerror(errno);
    return std::nullopt;
  }
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  bool ok = digest != nullptr && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) == 1;
  if (!ok) error = "libcrypto offers no SHA-256";
  std::vector<uint8_t> buffer(1 << 18);
  for (ssize_t got = 1; ok && got != 0;) {
    got = read(fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) error = std::strerror(errno);
    ok = got >= 0 && EVP_DigestUpdate(digest.get(), buffer.data(), static_cast<size_t>(got)) == 1;
  }
  close(fd);
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned int length = 0;
  if (!ok || EVP_DigestFinal_ex(digest.get(), bytes.data(), &length) != 1) return std::nullopt;
  return hexadecimal(bytes.data(), length);
}

}  // namespace tilepress
