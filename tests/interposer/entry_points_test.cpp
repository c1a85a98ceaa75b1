// Entry points: the search finds each name of the list and no other text.
#include <gtest/gtest.h>

#include <string>
#include <vector>

extern "C" {
#include "interposer/preload/entry_points.h"
}

namespace tilepress::testing {
namespace {

const std::vector<std::string> kNames = {
#define TP_ENTRY(name, ...) #name,
#include "interposer/preload/entry_points.def"
};

TEST(EntryPoints, EachNameIsFoundUnderItsOwnNumber) {
  ASSERT_EQ(kNames.size(), size_t{TP_ENTRY_COUNT});
  for (int entry = 0; entry < TP_ENTRY_COUNT; ++entry) {
    EXPECT_EQ(tp_find_entry(kNames[entry].c_str()), entry);
    EXPECT_EQ(tp_entry_names[entry], kNames[entry]);
  }
}

TEST(EntryPoints, NamesThatDifferByOneCharacterAreNotFound) {
  for (const std::string& name : kNames) {
    EXPECT_EQ(tp_find_entry(("x" + name).c_str()), -1);
    for (size_t at = 0; at < name.size(); ++at)
      for (const char other : {'\x01', '~'}) {
        std::string changed = name;
        changed[at] = other;
        EXPECT_EQ(tp_find_entry(changed.c_str()), -1) << changed;
      }
  }
  for (const char* name : {"", "e", "eg", "egl", "g", "O", "eglSwapBuffer", "eglSwapBuffersX", "printf"})
    EXPECT_EQ(tp_find_entry(name), -1) << name;
  EXPECT_EQ(tp_find_entry(nullptr), -1);
}

// The launcher's lines name what a program presents with. Ends of contexts and GLFW's swap would mislead
// there.
TEST(EntryPoints, KindsTellWhatACallDoes) {
  EXPECT_EQ(tp_entry_kinds[TP_ENTRY_eglSwapBuffers], TP_PRESENTS);
  EXPECT_EQ(tp_entry_kinds[TP_ENTRY_glXGetProcAddressARB], TP_LOOKS_UP);
  EXPECT_EQ(tp_entry_kinds[TP_ENTRY_eglTerminate], TP_DESTROYS);
  EXPECT_EQ(tp_entry_kinds[TP_ENTRY_glfwSwapBuffers], TP_SERVES_OSMESA);
}

}  // namespace
}  // namespace tilepress::testing
