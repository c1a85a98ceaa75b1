// Cache lock: one process at a time renders a key, also on a folder that several hosts share.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// A file that open() with O_EXCL makes. A thread of the holder touches the file every few seconds. A lock
/// whose process has died is taken over: at once if it died on this host, and after kStaleLock without a
/// touch if it was on another host. Clocks of hosts are not compared.
class CacheLock {
 public:
  CacheLock();
  CacheLock(const CacheLock&) = delete;
  CacheLock& operator=(const CacheLock&) = delete;
  ~CacheLock();  ///< removes the file if it is held

  /// Waits for the lock at `path`. Returns true once it is held; false once `given_up` returns true, which is
  /// called some times a second while another process holds the lock. Error: kFile, the path first.
  Result<bool> take(const std::string& path, const std::function<bool()>& given_up);

  static constexpr std::chrono::seconds kTouchPeriod{5};
  static constexpr std::chrono::seconds kStaleLock{60};

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// True if the lock at `path` is held by a process that is known to have died.
bool is_lock_of_dead_process(const std::string& path);

}  // namespace tilepress
