// File digest: SHA-256 by OpenSSL's libcrypto.
#include "tilepress/file_digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <cerrno>
#include <cstdio>
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
    unsigned char bytes[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    if (!good_ || EVP_DigestFinal_ex(digest_.get(), bytes, &length) != 1)
      return Error{ErrorKind::kSystem, "libcrypto cannot compute SHA-256"};
    return fmt::format("{:02x}", fmt::join(bytes, bytes + length, ""));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest_;
  bool good_ = false;
};

}  // namespace

Result<std::string> sha256_of_file(const std::string& path) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  Sha256 digest;
  std::vector<char> buffer(1 << 18);
  while (file != nullptr && std::feof(file.get()) == 0 && std::ferror(file.get()) == 0)
    digest.add(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), file.get()));
  if (file == nullptr || std::ferror(file.get()) != 0) return Error{ErrorKind::kFile, std::strerror(errno)};
  return digest.finish();
}

Result<std::string> sha256_of_bytes(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes.data(), bytes.size());
  return digest.finish();
}

}  // namespace tilepress
