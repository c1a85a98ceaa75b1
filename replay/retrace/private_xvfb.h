// Private Xvfb: an X server of our own, that nobody else can connect to.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "watched_process.h"

namespace tilepress {

class PrivateXvfb {
 public:
  /// Starts a server with a screen of at least the size given, on a display number that it finds itself; the
  /// cookie lies in `folder`. False and one line in `error` if there is none to start, if it does not come
  /// up, or once `stop` returns true.
  bool start(const std::string& folder, uint32_t width, uint32_t height, const std::function<bool()>& stop,
             std::string& error);
  const std::string& display() const { return display_; }      ///< ":7"
  const std::string& authority() const { return authority_; }  ///< for XAUTHORITY

 private:
  WatchedProcess server_;
  std::string display_, authority_;
};

}  // namespace tilepress
