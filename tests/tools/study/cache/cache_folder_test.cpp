// Tests of the cache folder: locks, last use, size limit, what dead processes leave.
#include "study/cache/cache_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "made_frames.h"
#include "study/cache/cache_lock.h"
#include "study/cache/host_name.h"
#include "tilepress/run_folder.h"

namespace tilepress {
namespace {

using testing::ElementsAre;

void set_used(const std::string& path, int64_t seconds) {
  const timespec times[2] = {{seconds, 0}, {seconds, 0}};
  ASSERT_EQ(utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

/// Bytes 100, 200 and 300; used in the order c, a, b, the last one most recently.
void make_three_files(const TestFolder& folder, int64_t first_used) {
  int64_t used = first_used;
  for (const auto& [name, bytes] : {std::pair("c", 300), std::pair("a", 100), std::pair("b", 200)}) {
    write_bytes(folder.file(name + std::string(".frames")), std::string(static_cast<size_t>(bytes), 'x'));
    set_used(folder.file(name + std::string(".frames")), used++);
  }
  write_bytes(folder.file("other.txt"), "x");
}

TEST(CacheFolder, ListsTheMostRecentlyUsedFirst) {
  const TestFolder folder;
  make_three_files(folder, 1000);
  const auto files = cache_files(folder.path());
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 3u);
  EXPECT_EQ((*files)[0].path, folder.file("b.frames"));
  EXPECT_EQ((*files)[1].path, folder.file("a.frames"));
  EXPECT_EQ((*files)[2].path, folder.file("c.frames"));
  EXPECT_EQ((*files)[0].bytes, 200u);
  EXPECT_EQ((*files)[0].used_s, 1002);
  note_use(folder.file("c.frames"));
  EXPECT_EQ(cache_files(folder.path())->front().path, folder.file("c.frames"));
  EXPECT_TRUE(cache_files(folder.file("missing"))->empty());
}

TEST(CacheFolder, SizeLimitRemovesTheLeastRecentlyUsed) {
  const TestFolder folder;
  make_three_files(folder, 1000);
  apply_size_limit(folder.path(), 600);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.frames", "b.frames", "c.frames", "other.txt"));
  apply_size_limit(folder.path(), 599);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.frames", "b.frames", "other.txt"));
  note_use(folder.file("b.frames"));
  apply_size_limit(folder.path(), 0);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("b.frames", "other.txt")) << "b is in use";
}

/// A process that takes the lock and dies with it.
void take_and_die(const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    CacheLock lock;
    const auto taken = lock.take(path, [] { return true; });
    _exit(taken && *taken ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
}

TEST(CacheLock, OneHoldsIt) {
  const TestFolder folder;
  const std::string path = folder.file("k.frames.lock");
  int asked = 0;
  const auto give_up = [&] { return ++asked == 2; };
  {
    CacheLock first, second;
    EXPECT_TRUE(*first.take(path, give_up));
    EXPECT_FALSE(*second.take(path, give_up));
    EXPECT_EQ(asked, 2);
    EXPECT_FALSE(is_lock_of_dead_process(path));
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(CacheLock, OfADeadProcessIsTakenOver) {
  const TestFolder folder;
  const std::string path = folder.file("k.frames.lock");
  take_and_die(path);
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_TRUE(is_lock_of_dead_process(path));
  CacheLock lock;
  EXPECT_TRUE(*lock.take(path, [] { return true; }));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("k.frames.lock"));
}

TEST(CacheLock, OfAnotherHostIsNotTakenOverAtOnce) {
  const TestFolder folder;
  const std::string path = folder.file("k.frames.lock");
  write_bytes(path, "another-host\n1\n1\n1\n");
  CacheLock lock;
  EXPECT_FALSE(*lock.take(path, [] { return true; }));
  EXPECT_FALSE(is_lock_of_dead_process(path));
}

TEST(CacheLock, NeedsAFolder) {
  const TestFolder folder;
  CacheLock lock;
  const auto taken = lock.take(folder.file("missing/k.lock"), [] { return true; });
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().text, folder.file("missing/k.lock") + ": No such file or directory");
}

TEST(CacheFolder, LeftoversAreThoseOfDeadProcesses) {
  const TestFolder folder;
  take_and_die(folder.file("dead.frames.lock"));
  write_bytes(folder.file("dead.frames.partial-h-1"), "x");
  write_bytes(folder.file("unlocked.frames.partial-h-1"), "x");
  CacheLock lock;
  ASSERT_TRUE(*lock.take(folder.file("live.frames.lock"), [] { return true; }));
  write_bytes(folder.file("live.frames.partial-h-1"), "x");
  write_bytes(folder.file("whole.frames"), "x");
  EXPECT_THAT(leftovers(folder.path()),
              ElementsAre(folder.file("dead.frames.lock"), folder.file("dead.frames.partial-h-1"),
                          folder.file("unlocked.frames.partial-h-1")));
}

}  // namespace
}  // namespace tilepress
