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
namespace {

class Sha256 {
 public:
  Sha256() : digest_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    good_ = digest_ != nullptr && EVP_DigestInit_ex(digest_.get(), EVP_sha256(), nullptr) == 1;
  }
  void add(const void* bytes, size_t count) {
    good_ = good_ && EVP_DigestUpdate(digest_.get(), bytes, count) == 1;
  }
  Result<std::string> finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
    unsigned int length = 0;
    if (!good_ || EVP_DigestFinal_ex(digest_.get(), bytes.data(), &length) != 1)
      return Error{ErrorKind::kSystem, "libcrypto cannot compute SHA-256"};
    return fmt::format("{:02x}", fmt::join(bytes.data(), bytes.data() + length, ""));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest_;
  bool good_ = false;
};

}  // namespace

Result<std::string> sha256_of_file(const std::string& path) {
  const auto fault = [] { return Error{ErrorKind::kFile, std::strerror(errno)}; };
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return fault();
  Sha256 digest;
  std::vector<uint8_t> buffer(1 << 18);
  ssize_t got = 1;
  while (got != 0) {
    got = read(fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    digest.add(buffer.data(), static_cast<size_t>(got));
  }
  const Error unread = fault();
  close(fd);
  if (got < 0) return unread;
  return digest.finish();
}

Result<std::string> sha256_of_bytes(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes.data(), bytes.size());
  return digest.finish();
}

}  // namespace tilepress
