// Surviving task: work that goes on when the program has ended without exit().
#pragma once

#include <functional>

namespace tilepress {

/// A task of the kernel that shares the program's memory and nothing else. It has its own thread group,
/// signal handlers, descriptors and working folder. exit_group, execve and SIGKILL end the program's threads,
/// and the memory stays until this task has ended as well.
///
/// The thread that calls run() lends the task its stack and its thread-local memory, so that C and C++ code
/// runs there as on any thread. The thread itself waits on a small stack of its own until the task ends.
class SurvivingTask {
 public:
  /// Runs `work` in a task and returns when the task has ended. The calling thread must have blocked all
  /// signals. If there can be no task, runs `work` on the calling thread.
  void run(const std::function<void()>& work);
  /// Why there was no task, or null.
  const char* obstacle() const { return obstacle_; }
  /// For `work`: returns true if the program's threads are gone. Always false without a task.
  bool program_gone() const;
  /// For `work`: notes progress. Once the program is gone, a task without progress for 30 seconds ends,
  /// because a thread that is gone may hold a lock for good.
  void note_progress() const;

 private:
  void enter();
  const char* obstacle_ = nullptr;
  bool in_task_ = false;
  int program_ = 0, thread_ = 0;  ///< the program's process, and its thread that waits for the task
};

}  // namespace tilepress
