// File digests against the examples of FIPS 180-4.
#include "tilepress/file_digest.h"

#include <gtest/gtest.h>

#include <string_view>

namespace tilepress {
namespace {

std::span<const uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

std::string digest_of(std::string_view text) {
  Sha256 digest;
  digest.add(bytes_of(text));
  return digest.finish();
}

TEST(Sha256, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest_of(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, IsTheSameInPiecesOfAnySize) {
  const std::string text(300, 'x');
  for (size_t piece = 1; piece < 130; ++piece) {
    Sha256 digest;
    for (size_t at = 0; at < text.size(); at += piece)
      digest.add(bytes_of(std::string_view(text).substr(at, piece)));
    EXPECT_EQ(digest.finish(), digest_of(text)) << piece;
  }
}

}  // namespace
}  // namespace tilepress
