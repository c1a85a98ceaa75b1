// File digest: SHA-256 by OpenSSL's libcrypto.
#include "tilepress/file_digest.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace tilepress {

Result<std::string> sha256_of_file(const std::string& path) {
  const auto fault = [] { return Error{ErrorKind::kFile, std::strerror(errno)}; };
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return fault();
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  bool good = digest != nullptr && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) == 1;
  std::vector<uint8_t> buffer(1 << 18);
  ssize_t got = 1;
  while (good && got != 0) {
    got = read(fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    good = EVP_DigestUpdate(digest.get(), buffer.data(), static_cast<size_t>(got)) == 1;
  }
  const Error unread = fault();
  close(fd);
  if (got < 0) return unread;
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned int length = 0;
  if (!good || EVP_DigestFinal_ex(digest.get(), bytes.data(), &length) != 1)
    return Error{ErrorKind::kSystem, "libcrypto cannot compute SHA-256"};
  return fmt::format("{:02x}", fmt::join(bytes.data(), bytes.data() + length, ""));
}

}  // namespace tilepress
