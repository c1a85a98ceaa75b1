// Trace survey: counts surfaces and frames, and learns what the recorded program used.
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
  /// Learns the API from the first window-system function that the trace defines, whether it is called or
  /// not.
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
  using Handler = void (*)(TraceSurvey&, const TraceCall&, Thread&);
  static const std::map<std::string_view, Handler>& handlers();

  TraceSurface& surface(uint64_t id);
  Context& context(uint64_t id);
  void present(uint64_t id, Thread& thread);
  void make_current(Thread& thread, uint64_t surface, uint64_t context, const TraceCall& call);
  void create_context(const TraceCall& call, std::string client_api);
  void resize(uint64_t id, int64_t width, int64_t height);
  void query_size(const TraceCall& call, int64_t width_name, int64_t height_name);
  void set_viewport(const TraceCall& call, Thread& thread);
  void note_time(const TraceCall& call);

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
