// Private session: which contexts are made, bound and left, in what order, on an API that is made up.
#include "interposer/engine/readback/private_session.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace tilepress {
namespace {

constexpr uintptr_t kWindow = 7, kOther = 8;
constexpr uint32_t kSide = 4;

void* handle(uintptr_t number) {
  return reinterpret_cast<void*>(number);
}

GlFunctions grey_gl() {
  GlFunctions gl;
  gl.GetString = [](GLenum name) {
    return reinterpret_cast<const GLubyte*>(name == GL_VERSION ? "OpenGL ES 3.2" : "");
  };
  gl.GetIntegerv = [](GLenum, GLint* value) { *value = 0; };
  gl.GetError = [] { return GLenum{GL_NO_ERROR}; };
  gl.PixelStorei = [](GLenum, GLint) {};
  gl.ReadBuffer = [](GLenum) {};
  gl.BindBuffer = [](GLenum, GLuint) {};
  gl.ReadPixels = [](GLint, GLint, GLsizei width, GLsizei height, GLenum, GLenum, void* pixels) {
    memset(pixels, 0x77, size_t(width) * size_t(height) * 4);
  };
  return gl;
}

/// Contexts are numbers: the program's is 1, ours follow from 100. Notes each call.
class MadeUpApi final : public ContextApi {
 public:
  Binding now{handle(1), kWindow, kWindow, handle(1)};
  bool comes_back = true, shares = true;
  std::set<uintptr_t> unbindable;  // contexts
  mutable std::vector<std::string> calls;

  Binding current() const override { return now; }
  bool can_come_back(const TilepressPresent&) const override { return comes_back; }
  GLenum buffer_of(const Drawable&) const override { return GL_BACK; }
  bool bind(const Binding& to) const override {
    const auto context = reinterpret_cast<uintptr_t>(to.context);
    calls.push_back("bind " + std::to_string(to.draw) + " " + std::to_string(to.read) + " " +
                    std::to_string(context));
    return unbindable.count(context) == 0;
  }
  bool bind_sharing(const Binding&, void* own) const override { return bind({handle(1), 0, 0, own}); }
  void* create_private(const Drawable&, const Binding&) const override { return made("create"); }
  void* create_sharing(const TilepressPresent&, const Binding&) override {
    return shares ? made("share") : nullptr;
  }
  bool create_twin(const Drawable&, void*, TwinContext&) const override { return false; }
  void destroy(void*, void* context) const override {
    calls.push_back("destroy " + std::to_string(reinterpret_cast<uintptr_t>(context)));
  }
  std::vector<std::string> taken_calls() const { return std::exchange(calls, {}); }

 private:
  void* made(const char* call) const {
    calls.push_back(std::string(call) + " " + std::to_string(next_));
    return handle(next_++);
  }
  mutable uintptr_t next_ = 100;
};

using Calls = std::vector<std::string>;

class PrivateSessionTest : public ::testing::Test {
 protected:
  Result<void> read(ReadWay way = ReadWay::kSync) {
    frame_.way = way;
    return session_.read(present_, drawable_, frame_);
  }

  const GlFunctions gl_ = grey_gl();
  MadeUpApi api_;
  LateReader reader_;
  TilepressPresent present_{};
  Drawable drawable_{{handle(1), kWindow}, {kSide, kSide, PixelFormat::kRgba8}, handle(50)};
  CapturedFrame frame_;
  PrivateSession session_{api_, gl_, reader_, false};
  PrivateSession in_context_{api_, gl_, reader_, true};
};

TEST_F(PrivateSessionTest, MakesOneContextPerConfigAndTheProgramsCurrentAgain) {
  ASSERT_TRUE(read());
  EXPECT_EQ(frame_.way, ReadWay::kSync);
  EXPECT_EQ(frame_.view.top_row[0], std::byte{0x77});
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 100", "bind 7 7 100", "bind 7 7 1"}));
  ASSERT_TRUE(read());
  EXPECT_EQ(api_.taken_calls(), (Calls{"bind 7 7 100", "bind 7 7 1"}));
  drawable_.config = handle(51);
  ASSERT_TRUE(read());
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 101", "bind 7 7 101", "bind 7 7 1"}));
}

TEST_F(PrivateSessionTest, ReplacesAContextThatCannotBeBoundAnyMore) {
  ASSERT_TRUE(read());
  api_.taken_calls();
  api_.unbindable = {100};
  ASSERT_TRUE(read());
  EXPECT_EQ(api_.taken_calls(), (Calls{"bind 7 7 100", "create 101", "bind 7 7 101", "bind 7 7 1"}));
}

TEST_F(PrivateSessionTest, ReadsInTheProgramsContextWhereNoPrivateOneCanBeBound) {
  api_.unbindable = {100};
  ASSERT_TRUE(read());
  EXPECT_EQ(frame_.way, ReadWay::kInContext);
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 100", "bind 7 7 100"}));
}

TEST_F(PrivateSessionTest, ReadsInPlaceWithoutBindingAnything) {
  ASSERT_TRUE(read(ReadWay::kInContext));
  EXPECT_EQ(frame_.way, ReadWay::kInContext);
  EXPECT_EQ(api_.taken_calls(), Calls{});
}

TEST_F(PrivateSessionTest, SwapsDrawAndReadWhereAnotherDrawableIsRead) {
  api_.now.read = kOther;
  ASSERT_TRUE(read(ReadWay::kInContext));
  EXPECT_EQ(api_.taken_calls(), (Calls{"bind 8 7 1", "bind 7 8 1"}));
}

TEST_F(PrivateSessionTest, ReadsAMultisampledDrawableInAPrivateContextAlone) {
  drawable_.multisampled = true;
  ASSERT_TRUE(read(ReadWay::kInContext));
  EXPECT_EQ(frame_.way, ReadWay::kSync);
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 100", "bind 7 7 100", "bind 7 7 1"}));
  EXPECT_EQ(in_context_.read(present_, drawable_, frame_).error().text,
            "a multisampled surface is resolved in a private context alone");
}

TEST_F(PrivateSessionTest, TriesNothingMoreWhereTheProgramsContextDoesNotComeBack) {
  api_.unbindable = {1};
  const Result<void> done = read();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kSystem);
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 100", "bind 7 7 100", "bind 7 7 1"}));
}

TEST_F(PrivateSessionTest, BindsNothingWhereTheProgramsContextCouldNotComeBack) {
  api_.comes_back = false;
  ASSERT_TRUE(read());
  EXPECT_EQ(frame_.way, ReadWay::kInContext);
  EXPECT_FALSE(session_.beside(present_, [] { FAIL(); }));
  api_.now.read = kOther;
  EXPECT_EQ(read().error().text, "the drawable that the program reads from is destroyed");
  EXPECT_EQ(api_.taken_calls(), Calls{});
}

TEST_F(PrivateSessionTest, BindsNothingWhereTheUserForbidsIt) {
  ASSERT_TRUE(in_context_.read(present_, drawable_, frame_));
  EXPECT_EQ(frame_.way, ReadWay::kInContext);
  EXPECT_FALSE(in_context_.beside(present_, [] { FAIL(); }));
  EXPECT_EQ(api_.taken_calls(), Calls{});
}

TEST_F(PrivateSessionTest, ReadsADrawableThatIsCurrentNowhereInAPrivateContextAlone) {
  api_.now = {};
  ASSERT_TRUE(read(ReadWay::kInContext));
  EXPECT_EQ(frame_.way, ReadWay::kSync);
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 100", "bind 7 7 100", "bind 0 0 0"}));
  api_.unbindable = {100, 101};
  EXPECT_EQ(read().error().text, "the private context cannot be made current");
  EXPECT_FALSE(session_.read_in_place(present_, drawable_, GL_FRONT, frame_));
  EXPECT_EQ(in_context_.read(present_, drawable_, frame_).error().text, "the drawable is current nowhere");
}

TEST_F(PrivateSessionTest, WorksBesideTheProgramInOneContextThatSharesWithIt) {
  int worked = 0;
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(session_.beside(present_, [&] { ++worked; }));
  EXPECT_EQ(worked, 2);
  EXPECT_EQ(api_.taken_calls(),
            (Calls{"share 100", "bind 0 0 100", "bind 7 7 1", "bind 0 0 100", "bind 7 7 1"}));
  api_.now.context = handle(2);
  api_.shares = false;
  EXPECT_FALSE(session_.beside(present_, [] { FAIL(); }));
}

TEST_F(PrivateSessionTest, DestroysItsContextsBeforeTheirDisplayAndForgetsThemAfterIt) {
  ASSERT_TRUE(read());
  ASSERT_TRUE(session_.beside(present_, [] {}));
  api_.taken_calls();
  session_.release(handle(2));
  EXPECT_EQ(api_.taken_calls(), Calls{});
  session_.release(handle(1));
  EXPECT_EQ(api_.taken_calls(), (Calls{"destroy 100", "destroy 101"}));
  ASSERT_TRUE(read());
  api_.taken_calls();
  session_.forget(handle(1));
  ASSERT_TRUE(read());
  EXPECT_EQ(api_.taken_calls(), (Calls{"create 103", "bind 7 7 103", "bind 7 7 1"}));
}

}  // namespace
}  // namespace tilepress
