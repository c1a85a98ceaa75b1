// File digests against the examples of FIPS 180-4.
#include "tilepress/file_digest.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace tilepress {
namespace {

std::string digest_of(const std::string& text) {
  const std::string path = testing::TempDir() + "tilepress_file_digest_test";
  std::ofstream(path, std::ios::binary) << text;
  const auto digest = sha256_of_file(path);
  std::remove(path.c_str());
  return digest ? *digest : digest.error().text;
}

TEST(FileDigest, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest_of(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(FileDigest, NamesTheReasonForAFileThatCannotBeRead) {
  const auto missing = sha256_of_file("/nonexistent/trace");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text, "No such file or directory");
  const auto folder = sha256_of_file("/");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().text, "Is a directory");
}

}  // namespace
}  // namespace tilepress
