// Frame queue: what a full queue gives to a program that does not wait.
#include "interposer/engine/worker/frame_queue.h"

#include <gtest/gtest.h>

namespace tilepress {
namespace {

TEST(FrameQueue, GivesNoFrameWithoutWaitingWhileItIsFull) {
  FrameQueue queue(2);
  for (int i = 0; i < 2; ++i) {
    CapturedFrame* frame = queue.acquire(false);
    ASSERT_NE(frame, nullptr);
    queue.submit(frame);
  }
  EXPECT_TRUE(queue.full());
  EXPECT_EQ(queue.acquire(false), nullptr);
  CapturedFrame* first = queue.next();
  EXPECT_EQ(queue.acquire(false), nullptr);  // the worker has not finished it
  queue.done(first);
  CapturedFrame* third = queue.acquire(false);
  ASSERT_NE(third, nullptr);
  queue.release(third);
  queue.done(queue.next());
  EXPECT_EQ(queue.pending(), 0u);
}

TEST(FrameQueue, CountsNoFrameThatIsBeingFilled) {
  FrameQueue queue(1);
  CapturedFrame* one = queue.acquire(false);
  CapturedFrame* other = queue.acquire(false);
  ASSERT_NE(one, nullptr);
  ASSERT_NE(other, nullptr);
  EXPECT_NE(one, other);
  queue.release(one);
  queue.release(other);
}

}  // namespace
}  // namespace tilepress
