// Interposed functions: programs and libraries that define functions of the C library run unharmed under the
// shim.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

class HookLibrary : public ::testing::TestWithParam<const char*> {
 protected:
  std::string path() const {
    const std::string preload = TILEPRESS_PRELOAD;
    return preload.substr(0, preload.rfind('/') + 1) + GetParam();
  }
};

// Another library may define any function, and musl lacks many. So no function is imported, and data is weak.
TEST_P(HookLibrary, ImportsNoFunctionOfAnotherLibrary) {
  const ProcessResult listed = run_process({"nm", "-D", "--undefined-only", path()}, {});
  ASSERT_TRUE(listed.exited_with(0)) << listed.err;
  std::istringstream lines(listed.out);
  for (std::string kind, name; lines >> kind >> name;) {
    const std::string bare = name.substr(0, name.find('@'));
    EXPECT_TRUE(kind == "w" || kind == "v") << kind << " " << name;
    if (kind == "w") {
      EXPECT_EQ(name, bare) << "a version that another C library does not have";
    }
  }
}

TEST_P(HookLibrary, RunsNothingWhenItIsLoaded) {
  const ProcessResult dynamic = run_process({"readelf", "-W", "-d", "-r", path()}, {});
  ASSERT_TRUE(dynamic.exited_with(0)) << dynamic.err;
  for (const char* absent :
       {"(INIT)", "(FINI)", "(INIT_ARRAY)", "(FINI_ARRAY)", "IRELATIV", "(RELR)", "TEXTREL"})
    EXPECT_EQ(dynamic.out.find(absent), std::string::npos) << absent;
}

/// Returns the names that `library` must export.
std::set<std::string> exports_of(const std::string& library) {
  if (library == "libEGL_tilepress.so.0") return {"__egl_Main"};
  if (library == "libGLX_tilepress.so.0") return {"__glx_Main"};
  std::set<std::string> names = {"dlsym", "dlvsym", "_exit", "_Exit", "__asan_default_options"};
#define TP_ENTRY(name, ...) names.insert(#name);
#include "interposer/preload/entry_points.def"
#define TP_GL_TRIGGER(name, kind) names.insert(#name);
#define TP_GL_TARGET(name, kind) \
  if (library == "libtilepress-preload-gl.so") names.insert(#name);
#include "interposer/preload/gl_names.def"
  return names;
}

TEST_P(HookLibrary, ExportsTheNamesOfTheListsAndNoOther) {
  const ProcessResult listed = run_process({"nm", "-D", "--defined-only", "--format=posix", path()}, {});
  ASSERT_TRUE(listed.exited_with(0)) << listed.err;
  std::istringstream lines(listed.out);
  std::set<std::string> found;
  for (std::string line; std::getline(lines, line);) found.insert(line.substr(0, line.find(' ')));
  EXPECT_EQ(found, exports_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Each, HookLibrary,
                         ::testing::Values("libtilepress-preload.so", "libtilepress-preload-gl.so",
                                           "libEGL_tilepress.so.0", "libGLX_tilepress.so.0"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name)
                             if (c == '-' || c == '.') c = '_';
                           return name;
                         });

void expect_picture(ShimTest& test, const std::vector<std::string>& program,
                    const std::map<std::string, std::string>& environment, const char* further_out = "") {
  std::vector<std::string> command = program;
  command.insert(command.end(), {"3", "32", "24"});
  const ShimRun run = test.run(command, environment);
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.status << run.process.err;
  EXPECT_EQ(run.process.out, std::string("error after the last swap: 0x3000\n") + further_out);
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].json_number("captured"), 3);
  EXPECT_EQ(test.dump(0, 2), expected_picture(2, 32, 24, true));
}

TEST(InterposedFunctions, NoneIsCalledWhileASymbolIsLookedUp) {
  for (const char* road : {"local", "getproc", "dlvsym"}) {
    ShimTest test;
    expect_picture(test, {TILEPRESS_EGL_INTERPOSING, road}, {});
  }
}

TEST(InterposedFunctions, PreloadedBeforeOrBehindTheShimTheyDoNotMatter) {
  const std::string ours = TILEPRESS_PRELOAD, theirs = TILEPRESS_INTERPOSED_FUNCTIONS;
  for (const std::string& order : {ours + ":" + theirs, theirs + ":" + ours}) {
    ShimTest test;
    expect_picture(test, {TILEPRESS_EGL_OPENED, "local"}, {{"LD_PRELOAD", order}});
  }
}

TEST(InterposedFunctions, AProgramWithADlsymOfItsOwnIsCaptured) {
  ShimTest test;
  expect_picture(test, {TILEPRESS_EGL_OWN_DLSYM, "local"}, {}, "own dlsym called\n");
}

TEST(InterposedFunctions, ADlsymBehindOursIsAskedAsWithoutTheShim) {
  const std::string ours = TILEPRESS_PRELOAD, theirs = TILEPRESS_OWN_DLSYM;
  for (const std::string& order : {ours + ":" + theirs, theirs + ":" + ours}) {
    ShimTest test;
    expect_picture(test, {TILEPRESS_EGL_OPENED, "local"}, {{"LD_PRELOAD", order}}, "own dlsym called\n");
  }
}

TEST(InterposedFunctions, ALookupBeforeTheShimIsRelocatedIsAnswered) {
  for (const char* library : {"", TILEPRESS_PRELOAD, TILEPRESS_PRELOAD_GL})
    EXPECT_TRUE(run_process({TILEPRESS_EARLY_LOOKUP}, {{"LD_PRELOAD", library}}).exited_with(2)) << library;
}

TEST(InterposedFunctions, LookupsAreAnsweredWhereEverythingIsBoundAtStart) {
  ShimTest test;
  expect_picture(test, {TILEPRESS_EGL_OPENED, "local"}, {{"LD_BIND_NOW", "1"}});
}

}  // namespace
}  // namespace tilepress::testing
