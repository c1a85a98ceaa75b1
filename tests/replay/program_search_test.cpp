// Program search: the file that a shell would run, or why there is none.
#include "tilepress/program_search.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace tilepress {
namespace {

namespace fs = std::filesystem;

class ProgramSearch : public testing::Test {
 protected:
  ProgramSearch() {
    std::string pattern = testing::TempDir() + "program_search_XXXXXX";
    folder_ = mkdtemp(pattern.data());
    path_ = std::getenv("PATH");
    for (const char* name : {"a", "b"}) fs::create_directory(folder_ + "/" + name);
    setenv("PATH", (folder_ + "/a:" + folder_ + "/b").c_str(), 1);
  }
  ~ProgramSearch() override {
    setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }
  std::string put(const std::string& name, fs::perms mode) const {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path) << "#!/bin/sh\n";
    fs::permissions(path, mode);
    return path;
  }
  std::string folder_, path_;
};

TEST_F(ProgramSearch, PassesOverFilesThatCannotBeRun) {
  put("a/tool", fs::perms::owner_read);
  const std::string second = put("b/tool", fs::perms::owner_all);
  const auto found = find_program("tool");
  ASSERT_TRUE(found) << found.error().text;
  EXPECT_EQ(*found, second);
}

TEST_F(ProgramSearch, TellsAMissingProgramFromOneThatCannotBeRun) {
  const auto missing = find_program("tool");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::kFile);
  EXPECT_EQ(missing.error().text, "tool: not found");
  const std::string plain = put("a/tool", fs::perms::owner_read);
  for (const std::string& name : {std::string("tool"), plain}) {
    const auto refused = find_program(name);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::kUnsupported);
    EXPECT_EQ(refused.error().text, plain + ": not executable");
  }
  const auto folder = find_program(folder_);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().text, folder_ + ": is a folder");
}

}  // namespace
}  // namespace tilepress
