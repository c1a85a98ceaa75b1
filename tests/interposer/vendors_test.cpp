// Vendors: if libglvnd knows several EGL vendors, the shim serves each, in the user's order.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "expected_picture.h"
#include "shim_process.h"
#include "tilepress/shim_environment.h"

namespace tilepress::testing {
namespace {

class Vendors : public ::testing::Test {
 protected:
  ~Vendors() override {
    unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
  }
  std::string vendor_file(const char* name, const std::string& library) {
    const std::string path = folder_.path() / name;
    std::ofstream(path) << R"({"file_format_version": "1.0.0", "ICD": {"library_path": ")" << library
                        << "\"}}";
    return path;
  }
  std::map<std::string, std::string> environment() {
    std::map<std::string, std::string> added = {{"LD_PRELOAD", ""}};
    const auto result = add_shim_environment(added, ShimRoad::kGlvnd, TILEPRESS_PRELOAD);
    EXPECT_TRUE(result) << result.error().text;
    return added;
  }
  void expect_captured(const std::map<std::string, std::string>& added) {
    ShimTest test;
    const ShimRun run = test.run({TILEPRESS_EGL_LINKED, "local", "3", "32", "24", "return"}, added);
    EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
    ASSERT_EQ(run.runs.size(), 1u) << run.log;
    EXPECT_EQ(run.runs[0].json_text("via"), "glvnd");
    EXPECT_EQ(run.runs[0].json_number("captured"), 3);
    EXPECT_EQ(test.dump(0, 2), expected_picture(2, 32, 24, true));
  }
  ScratchFolder folder_;
};

TEST_F(Vendors, ASecondVendorServesWhatTheFirstRefuses) {
  const std::string files = vendor_file("10_refusing.json", TILEPRESS_REFUSING_VENDOR) + ":" +
                            vendor_file("50_mesa.json", "libEGL_mesa.so.0");
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", files.c_str(), 1);
  const auto added = environment();
  EXPECT_EQ(added.at("TILEPRESS_EGL_VENDOR"), TILEPRESS_REFUSING_VENDOR);
  EXPECT_EQ(added.at("TILEPRESS_EGL_VENDOR_2"), "libEGL_mesa.so.0");
  expect_captured(added);
}

TEST_F(Vendors, FoldersOfTheUserAreSearchedInOrderOfNames) {
  vendor_file("90_refusing.json", TILEPRESS_REFUSING_VENDOR);
  vendor_file("50_mesa.json", "libEGL_mesa.so.0");
  vendor_file("60_mesa_again.json", "libEGL_mesa.so.0");
  setenv("__EGL_VENDOR_LIBRARY_DIRS", folder_.path().c_str(), 1);
  const auto added = environment();
  EXPECT_EQ(added.at("TILEPRESS_EGL_VENDOR"), "libEGL_mesa.so.0");
  EXPECT_EQ(added.at("TILEPRESS_EGL_VENDOR_2"), TILEPRESS_REFUSING_VENDOR);
  EXPECT_EQ(added.count("TILEPRESS_EGL_VENDOR_3"), 0u);
  expect_captured(added);
}

TEST_F(Vendors, AUsersChoiceOfGlxVendorIsPassedOn) {
  setenv("__GLX_VENDOR_LIBRARY_NAME", "chosen", 1);
  const auto added = environment();
  unsetenv("__GLX_VENDOR_LIBRARY_NAME");
  EXPECT_EQ(added.at("__GLX_VENDOR_LIBRARY_NAME"), "tilepress");
  EXPECT_EQ(added.at("TILEPRESS_GLX_VENDOR"), "chosen");
}

TEST_F(Vendors, TheOnlyGlxVendorIsPassedOnIfItIsOfTheSameDriver) {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", vendor_file("50_mesa.json", "libEGL_mesa.so.0").c_str(), 1);
  EXPECT_EQ(environment().at("TILEPRESS_GLX_VENDOR"), "mesa");
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", vendor_file("10_other.json", "libEGL_other.so.0").c_str(), 1);
  EXPECT_EQ(environment().count("__GLX_VENDOR_LIBRARY_NAME"), 0u);
  std::map<std::string, std::string> added;
  EXPECT_TRUE(add_shim_environment(added, ShimRoad::kAuto, TILEPRESS_PRELOAD));
  EXPECT_EQ(added.size(), added.count("LD_PRELOAD") + added.count("ASAN_OPTIONS"));
}

}  // namespace
}  // namespace tilepress::testing
