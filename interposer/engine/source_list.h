// Source list: the sources of this process, one per real presenting function.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/shim_log.h"
#include "interposer/engine/source/present_source.h"

namespace tilepress {

/// Thread-safe.
class SourceList {
 public:
  SourceList(const TilepressHost& host, bool in_context_only, ShimLog& log)
      : host_(host), in_context_only_(in_context_only), log_(log) {}

  /// Returns null if the library that presents lacks functions to read frames back.
  PresentSource* of(const TilepressPresent& present);
  /// Finds the API whose context is current on the calling thread, and fills in `present` as if the program
  /// presented what the context draws to or reads from. Returns null if there is none.
  PresentSource* of_current(const TilepressGlCall& call, FramebufferUse use, TilepressPresent& present);
  /// The program is about to tear down a display of `api`.
  void release(uint32_t api, void* display);
  /// The program is about to destroy a surface of `display`.
  void trim(void* display);

 private:
  struct Known {
    void* real;
    uint32_t api;
    std::unique_ptr<PresentSource> source;  ///< null: frames cannot be read back
  };
  void* public_function(uint32_t api);

  const TilepressHost host_;
  const bool in_context_only_;
  ShimLog& log_;
  LateReader reader_;
  std::mutex mutex_;  ///< guards known_
  std::vector<Known> known_;
  std::atomic<void*> public_[TILEPRESS_API_COUNT] = {};  ///< as public_function() found them
};

}  // namespace tilepress
