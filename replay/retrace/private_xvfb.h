// Private Xvfb: an X server that only our own children can connect to.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "watched_process.h"

namespace tilepress {

class PrivateXvfb {
 public:
  /// Starts a server with a screen of at least `width` x `height` pixels on a free display number. The cookie
  /// goes into `folder`. Error: Xvfb is not installed or does not come up, or `stop` returned true.
  Result<void> start(const std::string& folder, uint32_t width, uint32_t height,
                     const std::function<bool()>& stop);
  const std::string& display() const { return display_; }      ///< ":7"
  const std::string& authority() const { return authority_; }  ///< for XAUTHORITY

 private:
  WatchedProcess server_;
  std::string display_, authority_;
};

}  // namespace tilepress
