// Late reader: pixel buffers, their thread and the frame queue together, on a GL that is made up and may
// fail.
#include "interposer/engine/readback/late_reader.h"

#include <GL/glext.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <map>
#include <set>
#include <thread>

#include "interposer/engine/worker/frame_queue.h"
#include "interposer/engine/readback/gl_readback.h"
#include "interposer/engine/readback/pixel_buffer_groups.h"

namespace tilepress {
namespace {

constexpr uint32_t kSide = 4;
constexpr size_t kBytes = size_t{kSide} * kSide * 4;

/// A GL whose frame N has all bytes N, and whose fences are signalled when the test says so.
struct MadeUpGl {
  std::mutex mutex;
  std::string version = "OpenGL ES 3.2";
  uint8_t frame = 0;
  GLuint next_name = 1;
  std::map<GLuint, std::vector<std::byte>> buffers;
  std::set<uintptr_t> fences;
  uintptr_t next_fence = 1;
  size_t most_buffers = 0;
  std::atomic<bool> signalled{true};
  bool no_fence = false, no_map = false, other_pixels = false, lost = false;
  GLenum error = GL_NO_ERROR;
} made_up;

thread_local GLuint bound = 0;  // each thread has a context of its own

using Lock = std::lock_guard<std::mutex>;

GlFunctions made_up_functions() {
  GlFunctions gl;
  gl.GetString = [](GLenum) -> const GLubyte* {
    return reinterpret_cast<const GLubyte*>(made_up.version.c_str());
  };
  gl.GetIntegerv = [](GLenum, GLint* value) { *value = 0; };
  gl.GetError = [] {
    const Lock lock(made_up.mutex);
    return std::exchange(made_up.error, GLenum{GL_NO_ERROR});
  };
  gl.PixelStorei = [](GLenum, GLint) {};
  gl.ReadBuffer = [](GLenum) {};
  gl.ReadPixels = [](GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void* pixels) {
    const Lock lock(made_up.mutex);
    if (bound != 0) pixels = made_up.buffers.at(bound).data();
    memset(pixels, made_up.frame + (bound != 0 && made_up.other_pixels ? 1 : 0), kBytes);
  };
  gl.GenBuffers = [](GLsizei, GLuint* name) {
    const Lock lock(made_up.mutex);
    made_up.buffers[*name = made_up.next_name++] = {};
    made_up.most_buffers = std::max(made_up.most_buffers, made_up.buffers.size());
  };
  gl.DeleteBuffers = [](GLsizei, const GLuint* name) {
    const Lock lock(made_up.mutex);
    made_up.buffers.erase(*name);
  };
  gl.BindBuffer = [](GLenum, GLuint name) { bound = name; };
  gl.BufferData = [](GLenum, ptrdiff_t bytes, const void*, GLenum) {
    const Lock lock(made_up.mutex);
    made_up.buffers.at(bound).resize(static_cast<size_t>(bytes));
  };
  gl.MapBufferRange = [](GLenum, ptrdiff_t, ptrdiff_t, GLbitfield) -> void* {
    const Lock lock(made_up.mutex);
    return made_up.no_map ? nullptr : made_up.buffers.at(bound).data();
  };
  gl.UnmapBuffer = [](GLenum) -> GLboolean { return GL_TRUE; };
  gl.FenceSync = [](GLenum, GLbitfield) -> void* {
    const Lock lock(made_up.mutex);
    if (made_up.no_fence) return nullptr;
    made_up.fences.insert(made_up.next_fence);
    return reinterpret_cast<void*>(made_up.next_fence++);
  };
  gl.ClientWaitSync = [](void*, GLbitfield, uint64_t timeout_ns) -> GLenum {
    if (made_up.lost) return GL_WAIT_FAILED;
    for (uint64_t waited_ns = 0; waited_ns < timeout_ns; waited_ns += 1'000'000) {
      if (made_up.signalled) return GL_CONDITION_SATISFIED;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return GL_TIMEOUT_EXPIRED;
  };
  gl.DeleteSync = [](void* fence) {
    const Lock lock(made_up.mutex);
    made_up.fences.erase(reinterpret_cast<uintptr_t>(fence));
  };
  gl.Flush = [] {};
  return gl;
}

struct ThreeFrames : FrameQueue {
  ThreeFrames() : FrameQueue(3) {}
};

class LateReading : public ::testing::Test {
 protected:
  LateReading() {
    made_up.version = "OpenGL ES 3.2";
    made_up.frame = 0;
    made_up.buffers.clear();
    made_up.fences.clear();
    made_up.most_buffers = 0;
    made_up.signalled = true;
    made_up.no_fence = made_up.no_map = made_up.other_pixels = made_up.lost = false;
  }

  void TearDown() override {
    made_up.signalled = true;
    reader_.let_go(nullptr);
  }

  std::shared_ptr<PixelBuffers> buffers(ReadWay way) {
    return groups_.of_context(&context_, way, gl_, &display_, reader_, [this](TwinContext& twin) {
      twin.enter = [this] { return enters_ && ++entered_ > 0; };
      twin.leave = [this] { ++left_; };
      twin.destroy = [] {};
      return true;
    });
  }

  /// As a source reads: false if nothing was read.
  bool read(CapturedFrame& frame, ReadWay way) {
    frame.way = way;
    frame.arrive = [this, &frame](bool whole) { queue_.arrived(&frame, whole); };
    const SurfaceShape shape{kSide, kSide, PixelFormat::kRgba8};
    const bool taken = read_back_buffer(gl_, shape, buffers(way), frame);
    if (frame.late != nullptr) reader_.post(frame);
    return taken;
  }

  CapturedFrame* present(uint8_t number, ReadWay way) {
    CapturedFrame* frame = queue_.acquire(true);
    made_up.frame = number;
    frame->frame = number;
    EXPECT_TRUE(read(*frame, way));
    queue_.submit(frame);
    return frame;
  }

  static uint8_t pixel_of(const CapturedFrame& frame) { return static_cast<uint8_t>(frame.view.top_row[0]); }

  template <typename Part>
  static Part& left_behind() {
    static std::vector<std::unique_ptr<Part>>& all = *new std::vector<std::unique_ptr<Part>>;
    return *all.emplace_back(std::make_unique<Part>());
  }

  // Left behind, as in a process: the reader's thread has no end.
  const GlFunctions gl_ = made_up_functions();
  int context_ = 0, display_ = 0;
  LateReader& reader_ = left_behind<LateReader>();
  FrameQueue& queue_ = left_behind<ThreeFrames>();
  PixelBufferGroups& groups_ = left_behind<PixelBufferGroups>();
  bool enters_ = true;
  std::atomic<int> entered_{0}, left_{0};
};

TEST_F(LateReading, FramesComeInOrderWithTheirPixelsWhateverTheirWay) {
  for (uint8_t number = 0; number < 60; ++number) {
    const ReadWay way = number % 3 == 0 ? ReadWay::kSync : ReadWay::kAsync;
    present(number, way);
    CapturedFrame* frame = queue_.next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->frame, number);
    EXPECT_EQ(frame->way, way);
    EXPECT_FALSE(frame->lost);
    EXPECT_EQ(pixel_of(*frame), number);
    queue_.done(frame);
  }
  EXPECT_EQ(entered_, 1);
  EXPECT_EQ(made_up.most_buffers, 1u);
  EXPECT_TRUE(made_up.fences.empty());
}

TEST_F(LateReading, AFrameThatIsStillOnItsWayHoldsBackThoseBehindIt) {
  made_up.signalled = false;
  present(1, ReadWay::kAsync);
  present(2, ReadWay::kSync);
  queue_.wake();
  EXPECT_EQ(queue_.next(), nullptr);  // woken, and the first is not there yet
  made_up.signalled = true;
  for (const uint8_t number : {1, 2}) {
    CapturedFrame* frame = queue_.next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->frame, number);
    EXPECT_EQ(pixel_of(*frame), number);
    queue_.done(frame);
  }
}

TEST_F(LateReading, LettingGoWaitsForWhatIsOnItsWay) {
  made_up.signalled = false;
  CapturedFrame* frame = queue_.acquire(true);
  made_up.frame = 7;
  ASSERT_TRUE(read(*frame, ReadWay::kAsync));
  std::thread later([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    made_up.signalled = true;
  });
  EXPECT_TRUE(reader_.let_go(&display_));
  EXPECT_EQ(pixel_of(*frame), 7);
  EXPECT_EQ(left_, 1);
  later.join();
  queue_.release(frame);
}

TEST_F(LateReading, LettingGoGivesUpOnADriverThatHangs) {
  made_up.signalled = false;
  CapturedFrame* frame = queue_.acquire(true);
  ASSERT_TRUE(read(*frame, ReadWay::kAsync));
  EXPECT_FALSE(reader_.let_go(&display_));
  made_up.signalled = true;
  EXPECT_TRUE(reader_.let_go(&display_));
  queue_.release(frame);
}

TEST_F(LateReading, OfAnotherDisplayNothingIsLetGo) {
  present(1, ReadWay::kAsync);
  const int other = 0;
  EXPECT_TRUE(reader_.let_go(&other));
  EXPECT_EQ(left_, 0);
  EXPECT_TRUE(reader_.let_go(&display_));
  EXPECT_EQ(left_, 1);
}

TEST_F(LateReading, AFrameThatIsNotPresentedGoesBackOnceItsPixelsAreThere) {
  made_up.signalled = false;
  CapturedFrame* frame = queue_.acquire(true);
  ASSERT_TRUE(read(*frame, ReadWay::kAsync));
  queue_.release(frame);
  CapturedFrame* second = queue_.acquire(true);
  EXPECT_NE(second, frame);  // which is still being written to
  queue_.release(second);
  made_up.signalled = true;
  EXPECT_TRUE(reader_.let_go(&display_));
  EXPECT_EQ(queue_.acquire(true), frame);
  EXPECT_EQ(queue_.pending(), 0u);
  queue_.release(frame);
}

TEST_F(LateReading, PixelsThatNeverArriveAreALostFrameNotAWait) {
  made_up.lost = true;
  present(1, ReadWay::kAsync);
  CapturedFrame* frame = queue_.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(frame->lost);
  queue_.done(frame);
  // And no further frame is read so.
  made_up.lost = false;
  EXPECT_EQ(present(2, ReadWay::kAsync)->way, ReadWay::kSync);
  frame = queue_.next();
  EXPECT_FALSE(frame->lost);
  EXPECT_EQ(pixel_of(*frame), 2);
  queue_.done(frame);
  EXPECT_TRUE(made_up.fences.empty());
}

TEST_F(LateReading, AtTheEndOfTheProcessAHangingDriverIsNotWaitedForLong) {
  made_up.signalled = false;
  present(1, ReadWay::kAsync);
  present(2, ReadWay::kSync);
  EXPECT_TRUE(queue_.close());
  CapturedFrame* frame = queue_.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(frame->lost);
  queue_.done(frame);
  frame = queue_.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->frame, 2u);
  EXPECT_FALSE(frame->lost);
  queue_.done(frame);
  EXPECT_TRUE(queue_.closed_and_empty());
  made_up.signalled = true;
}

class MissingPart : public LateReading, public ::testing::WithParamInterface<const char*> {};

TEST_P(MissingPart, MeansSynchronousReads) {
  const std::string part = GetParam();
  if (part == "version") made_up.version = "OpenGL ES 2.0";
  if (part == "fence") made_up.no_fence = true;
  if (part == "twin") enters_ = false;
  for (uint8_t number = 0; number < 3; ++number) {
    EXPECT_EQ(present(number, ReadWay::kAsync)->way, ReadWay::kSync);
    CapturedFrame* frame = queue_.next();
    EXPECT_EQ(pixel_of(*frame), number);
    queue_.done(frame);
  }
  EXPECT_TRUE(made_up.buffers.empty());
}
INSTANTIATE_TEST_SUITE_P(LateReading, MissingPart, ::testing::Values("version", "fence", "twin"));

TEST_F(LateReading, AProbeNeedsNoThreadAndLeavesNoBuffer) {
  CapturedFrame* frame = queue_.acquire(true);
  for (uint8_t number = 0; number < 5; ++number) {
    made_up.frame = number;
    ASSERT_TRUE(read(*frame, ReadWay::kBoth));
    EXPECT_GT(frame->buffered_ns, 0u);
    EXPECT_EQ(pixel_of(*frame), number);
  }
  EXPECT_EQ(made_up.most_buffers, 1u);
  ASSERT_TRUE(read(*frame, ReadWay::kSync));
  EXPECT_TRUE(made_up.buffers.empty());
  EXPECT_EQ(entered_, 0);
  queue_.release(frame);
}

TEST_F(LateReading, ABufferWithOtherPixelsThanTheCallGivesIsNeverUsed) {
  made_up.other_pixels = true;
  CapturedFrame* frame = queue_.acquire(true);
  made_up.frame = 3;
  ASSERT_TRUE(read(*frame, ReadWay::kBoth));
  EXPECT_EQ(frame->buffered_ns, 0u);
  EXPECT_EQ(pixel_of(*frame), 3);
  ASSERT_TRUE(read(*frame, ReadWay::kAsync));
  EXPECT_EQ(frame->way, ReadWay::kSync);
  EXPECT_EQ(pixel_of(*frame), 3);
  queue_.release(frame);
}

TEST_F(LateReading, BuffersAreFewAndGoWithTheSurface) {
  made_up.signalled = false;
  for (uint8_t number = 0; number < 3; ++number) present(number, ReadWay::kAsync);
  EXPECT_EQ(made_up.most_buffers, 3u);
  made_up.signalled = true;
  trim_later(groups_.of_display(&display_), reader_);
  EXPECT_TRUE(reader_.let_go(&display_));
  EXPECT_TRUE(made_up.buffers.empty());
  for (uint8_t number = 0; number < 3; ++number) {
    CapturedFrame* frame = queue_.next();
    EXPECT_EQ(pixel_of(*frame), number);
    queue_.done(frame);
  }
}

// It has no such thread, and the locks may be held by it.
TEST_F(LateReading, InAForkedChildTheParentsReaderIsNotWaitedFor) {
  present(1, ReadWay::kAsync);
  const pid_t child = fork();
  if (child == 0) {
    bool ran = false;
    reader_.post(buffers(ReadWay::kBoth), [&](bool entered) { ran = !entered; });
    _exit(ran && reader_.let_go(&display_) ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace tilepress
