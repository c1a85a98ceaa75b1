// What a worker of a study does next.
#include "study/work_queue.h"

#include <gtest/gtest.h>

namespace tilepress {
namespace {

StudyTask task_of(size_t workload) {
  return {.id = "task", .workload = workload, .configurations = {0}};
}

PreparedWorkload of_pixels(uint64_t pixels) {
  PreparedWorkload prepared;
  prepared.pixels = pixels;
  return prepared;
}

TEST(WorkQueue, PreparesInOrderAndAFewTasksAhead) {
  WorkQueue queue({4, 7, 9}, 2);
  const StudyTask task = task_of(4);
  const PreparedWorkload prepared = of_pixels(1);
  EXPECT_EQ(queue.next()->workload, 4u);
  queue.prepared({&task}, &prepared);
  EXPECT_EQ(queue.next()->task, nullptr) << "one task waits, two may";
  queue.prepared({&task}, &prepared);
  EXPECT_EQ(queue.next()->task, &task) << "two tasks wait";
  const auto third = queue.next();
  EXPECT_EQ(third->task, nullptr);
  EXPECT_EQ(third->workload, 9u);
}

TEST(WorkQueue, TakesTheTaskWithTheMostPixelsFirst) {
  WorkQueue queue({0, 1, 2}, 8);
  const StudyTask tasks[] = {task_of(0), task_of(1), task_of(2)};
  const PreparedWorkload prepared[] = {of_pixels(10), of_pixels(30), of_pixels(20)};
  for (int i = 0; i < 3; ++i) queue.next();
  for (int i = 0; i < 3; ++i) queue.prepared({&tasks[i]}, &prepared[i]);
  EXPECT_EQ(queue.next()->task, &tasks[1]);
  EXPECT_EQ(queue.next()->task, &tasks[2]);
  EXPECT_EQ(queue.next()->task, &tasks[0]);
  EXPECT_FALSE(queue.next());
}

TEST(WorkQueue, EndsWhenNothingIsLeftOrAllIsDropped) {
  WorkQueue queue({0, 1}, 8);
  queue.next();
  queue.stop();
  queue.prepared({}, nullptr);
  EXPECT_FALSE(queue.next());
}

}  // namespace
}  // namespace tilepress
