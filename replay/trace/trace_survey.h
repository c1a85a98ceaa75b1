// Trace survey: watches the calls that tell what a trace shows, and keeps count of its surfaces and frames.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tilepress/trace_summary.h"
#include "trace_events.h"

namespace tilepress {

class TraceSurvey {
 public:
  static constexpr size_t kMaxHandles = 1 << 16;  ///< surfaces, contexts or threads

  static bool watches(std::string_view function);
  void see(const TraceCall& call, const TraceFunction& function);
  /// The API is known from the first function of a window system interface, called or not.
  void see_function(std::string_view name);
  void report(TraceSummary& summary) const;

 private:
  struct Context {
    std::string client_api;
    uint64_t draw_framebuffer = 0;
    bool presented = false;
  };
  struct Thread {
    uint64_t surface = 0, context = 0;
    uint64_t bound_api = 0;
  };
  using Handler = void (TraceSurvey::*)(const TraceCall&, Thread&);
  static const std::map<std::string_view, Handler>& handlers();

  TraceSurface& surface(uint64_t id);
  Context& context(uint64_t id);
  void present(uint64_t id, Thread& thread);
  void make_current(Thread& thread, uint64_t surface, uint64_t context, const TraceCall& call);
  void resize(uint64_t id, int64_t width, int64_t height);

  void present_second(const TraceCall& call, Thread& thread);  // surface is argument 1
  void present_first(const TraceCall& call, Thread& thread);   // surface is argument 0
  void egl_make_current(const TraceCall& call, Thread& thread);
  void glx_make_current(const TraceCall& call, Thread& thread);
  void wgl_make_current(const TraceCall& call, Thread& thread);
  void glx_make_context_current(const TraceCall& call, Thread& thread);
  void egl_bind_api(const TraceCall& call, Thread& thread);
  void egl_create_context(const TraceCall& call, Thread& thread);
  void egl_create_pbuffer(const TraceCall& call, Thread& thread);
  void egl_query_surface(const TraceCall& call, Thread& thread);
  void glx_create_context(const TraceCall& call, Thread& thread);
  void glx_create_context_attributes(const TraceCall& call, Thread& thread);
  void glx_create_pbuffer(const TraceCall& call, Thread& thread);
  void glx_query_drawable(const TraceCall& call, Thread& thread);
  void gl_viewport(const TraceCall& call, Thread& thread);
  void gl_bind_framebuffer(const TraceCall& call, Thread& thread);
  void gl_get_string(const TraceCall& call, Thread& thread);
  void gl_get_integer64(const TraceCall& call, Thread& thread);

  TraceApi api_ = TraceApi::kUnknown;
  std::unordered_map<uint64_t, Thread> threads_;
  std::unordered_map<uint64_t, TraceSurface> surfaces_;
  std::vector<uint64_t> presented_;  ///< surface ids, by first presentation
  std::unordered_map<uint64_t, Context> contexts_;
  uint64_t frames_ = 0;
  std::string gl_version_, gl_renderer_;
  int64_t first_time_ns_ = 0, last_time_ns_ = 0;
};

}  // namespace tilepress
