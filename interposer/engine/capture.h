// Capture: everything the shim knows in one process, from the first presenting call on.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/worker/capture_worker.h"
#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/source/present_source.h"
#include "interposer/engine/present_times.h"
#include "interposer/engine/readback/readback_probe.h"
#include "interposer/engine/shim_log.h"
#include "interposer/engine/surface_registry.h"
#include "tilepress/run_options.h"

namespace tilepress {

/// Belongs to one process id: a forked child makes its own and leaves the parent's alone, locks and all.
class Capture {
 public:
  explicit Capture(const TilepressHost& host);
  int64_t pid() const { return pid_; }

  /// As TilepressEngine.begin and end: the capture, and around it what --measure-overhead asks for.
  bool begin(TilepressPresent& present);
  void end(TilepressPresent& present, bool presented);
  void gl_call(const TilepressGlCall& call);
  void contexts_going(uint32_t api, void* display, void* context);
  void surface_going(void* display, uintptr_t surface);
  void finish();

 private:
  enum class Outcome : uint32_t { kTaken = 1, kSkipped, kDropped, kUnsupported, kNotCaptured };
  struct Source {
    void* real;
    uint32_t api;
    std::unique_ptr<PresentSource> source;  ///< null: cannot be read
  };
  /// A frame that could be taken.
  struct Shot {
    WindowKey key;
    SurfaceShape shape;
    const char* cause = "swap";
    std::string origin = "window";
    std::string damage;
    uint64_t begin_ns = 0;  ///< when its capture began
    bool any_way = false;   ///< its pixels may come late
    /// A window that Mesa draws on the processor. It may be resized at any time, and to make another context
    /// current on it would have the driver take new buffers: what was drawn would never be shown. Of other
    /// drivers NVIDIA's keeps what was drawn then, but loses it, or ends the program, where the window is
    /// read in the program's context.
    bool software_window = false;
    std::function<bool(CapturedFrame& frame, std::string& reason)> read;
  };
  /// What came of it, between begin and end.
  struct Take {
    Outcome outcome = Outcome::kNotCaptured;
    SurfaceRole role = SurfaceRole::kPresented;
    uint32_t window = ~0u;  ///< none
    CapturedFrame* frame = nullptr;
    uint64_t begin_ns = 0;
    bool triggered = false;  ///< by another than a presenting call
  };

  bool begin_capture(TilepressPresent& present, uint64_t begin_ns);
  void end_capture(TilepressPresent& present, bool presented);
  PresentSource* source_of(const TilepressPresent& present);
  Take take(const Shot& shot, CaptureWorker& worker);
  Take miss(const Shot& shot, const std::string& reason);
  void commit(const Take& take);
  bool first_time(const std::string& reason);
  void report(uint32_t surface, const std::string& reason);
  CaptureWorker* worker(const TilepressPresent& present, const PresentSource& source);
  bool is_capturing() const;
  void forget_targets(const void* context, uintptr_t image = 0, uintptr_t mask = 0);

  // In capture_gl.cpp: frames that no presenting call ends.
  PresentSource* source_of(const TilepressGlCall& call, TilepressPresent& present);
  void* public_function(uint32_t api);
  void trigger(const TilepressGlCall& call, const TilepressPresent& present, PresentSource& source);
  void take_default_framebuffer(const TilepressGlCall& call, const TilepressPresent& present,
                                PresentSource& source, FramebufferUse use);
  void take_attachments(const TilepressPresent& present, PresentSource& source,
                        const std::vector<Attachment>& attachments, FramebufferUse use, SurfaceRole role,
                        const char* cause);

  const TilepressHost host_;
  const int64_t pid_;
  RunOptions options_;
  std::unique_ptr<ShimLog> log_;
  std::atomic<bool> enabled_{false};
  bool counting_only_ = false;  ///< TILEPRESS_CAPTURE=off
  PresentTimes times_;
  uint64_t start_ns_ = 0;
  CaptureCounts counts_;
  SurfaceRegistry registry_;
  std::mutex mutex_;  ///< guards sources_, told_ and the making of worker_
  std::vector<Source> sources_;
  std::set<std::string> told_;
  std::atomic<void*> public_[TILEPRESS_API_COUNT] = {};  ///< presenting functions of libraries known by name
  std::unique_ptr<ReadbackChoices> readback_;
  LateReader reader_;
  std::atomic<CaptureWorker*> worker_{nullptr};  ///< never destroyed: the process may end at any time
};

}  // namespace tilepress
