// Ending signals: what SIGINT, SIGTERM and SIGHUP do to a verb.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tilepress {

/// How a verb ends on a signal. A signal that the parent process ignores stays ignored.
enum class OnSignal : uint8_t {
  kVerbsOwn,    ///< the verb decides
  kEndAtOnce,   ///< unfinished files are removed, one line, exit 128+n
  kEndInOrder,  ///< the verb looks at noted_signal(); a second signal kills
};
void choose_on_signal(OnSignal choice);

/// Number of the signal that asked a verb with kEndInOrder to end; 0 before. From that signal on, blocking
/// system calls return EINTR every 50 ms.
const std::atomic<int>& noted_signal();

/// "killed by signal 2", as run.json writes it.
std::string state_after(int signal);
/// "killed by signal 2 (Interrupt)"
std::string signal_text(int signal);

/// While this object lives, a signal with kEndAtOnce removes the file.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::string& path);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

 private:
  static constexpr size_t kNone = SIZE_MAX;
  size_t slot_ = kNone;
};

}  // namespace tilepress
