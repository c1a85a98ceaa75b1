// Trace survey: a handler per recorded function.
#include "trace_survey.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace tilepress {
namespace {

// Enumerants of EGL, GLX and GL, under their own names.
constexpr int64_t EGL_HEIGHT = 0x3056, EGL_WIDTH = 0x3057, EGL_CONTEXT_MAJOR_VERSION = 0x3098,
                  EGL_OPENGL_API = 0x30A2, EGL_CONTEXT_MINOR_VERSION = 0x30FB;
constexpr int64_t GLX_WIDTH = 0x801D, GLX_HEIGHT = 0x801E, GLX_PBUFFER_HEIGHT = 0x8040,
                  GLX_PBUFFER_WIDTH = 0x8041, GLX_CONTEXT_MAJOR_VERSION = 0x2091,
                  GLX_CONTEXT_MINOR_VERSION = 0x2092, GLX_CONTEXT_PROFILE_MASK = 0x9126,
                  GLX_CONTEXT_ES_PROFILE_BIT = 4;
constexpr int64_t GL_RENDERER = 0x1F01, GL_VERSION = 0x1F02, GL_FRAMEBUFFER = 0x8D40,
                  GL_DRAW_FRAMEBUFFER = 0x8CA9, GL_TIMESTAMP = 0x8E28;

int64_t argument(const TraceCall& call, size_t position, int64_t otherwise = 0) {
  return position < call.arguments.size() ? call.arguments[position].as_number(otherwise) : otherwise;
}

uint64_t handle(const TraceCall& call, size_t position) {
  return static_cast<uint64_t>(argument(call, position));
}

uint64_t result_handle(const TraceCall& call) {
  return static_cast<uint64_t>(call.result.as_number());
}

/// Looks `key` up in a list of key, value, key, value, … that argument `position` holds.
int64_t attribute(const TraceCall& call, size_t position, int64_t key, int64_t otherwise) {
  if (position >= call.arguments.size()) return otherwise;
  const std::vector<TraceValue>& list = call.arguments[position].items;
  for (size_t i = 0; i + 1 < list.size(); i += 2)
    if (list[i].as_number() == key) return list[i + 1].as_number(otherwise);
  return otherwise;
}

std::string versioned(const char* api, int64_t major, int64_t minor) {
  return std::string(api) + " " + std::to_string(major) + "." + std::to_string(minor);
}

}  // namespace

const std::map<std::string_view, TraceSurvey::Handler>& TraceSurvey::handlers() {
  using S = TraceSurvey;
  using Call = const TraceCall&;
  const Handler present_first = [](S& s, Call call, Thread& thread) { s.present(handle(call, 0), thread); };
  const Handler present_second = [](S& s, Call call, Thread& thread) { s.present(handle(call, 1), thread); };
  const Handler read_and_draw_current = [](S& s, Call call, Thread& thread) {
    s.make_current(thread, handle(call, 1), handle(call, 3), call);
  };
  const Handler glx_create_context = [](S& s, Call call, Thread&) { s.create_context(call, "OpenGL"); };
  const Handler bind_framebuffer = [](S& s, Call call, Thread& thread) {
    const int64_t target = argument(call, 0);
    if (target == GL_FRAMEBUFFER || target == GL_DRAW_FRAMEBUFFER)
      s.context(thread.context).draw_framebuffer = handle(call, 1);
  };
  // A presentation is a call that a retracer repeats with a swap. apitrace also ends a frame at
  // glXSwapBuffersMscOML and glFrameTerminatorGREMEDY, but these present nothing in a replay.
  static const std::map<std::string_view, Handler> kHandlers = {
      {"eglSwapBuffers", present_second},
      {"eglSwapBuffersWithDamageEXT", present_second},
      {"eglSwapBuffersWithDamageKHR", present_second},
      {"glXSwapBuffers", present_second},
      {"wglSwapBuffers", present_first},
      {"wglSwapLayerBuffers", present_first},
      {"CGLFlushDrawable", present_first},
      {"eglMakeCurrent", read_and_draw_current},
      {"glXMakeContextCurrent", read_and_draw_current},
      {"glXMakeCurrentReadSGI", read_and_draw_current},
      {"glXMakeCurrent",
       [](S& s, Call call, Thread& thread) {
         s.make_current(thread, handle(call, 1), handle(call, 2), call);
       }},
      {"wglMakeCurrent",
       [](S& s, Call call, Thread& thread) {
         s.make_current(thread, handle(call, 0), handle(call, 1), call);
       }},
      {"eglBindAPI", [](S&, Call call, Thread& thread) { thread.bound_api = handle(call, 0); }},
      {"eglCreateContext",
       [](S& s, Call call, Thread& thread) {
         const bool desktop = thread.bound_api == static_cast<uint64_t>(EGL_OPENGL_API);
         s.create_context(call, versioned(desktop ? "OpenGL" : "OpenGL ES",
                                          attribute(call, 3, EGL_CONTEXT_MAJOR_VERSION, 1),
                                          attribute(call, 3, EGL_CONTEXT_MINOR_VERSION, 0)));
       }},
      {"glXCreateContext", glx_create_context},
      {"glXCreateNewContext", glx_create_context},
      {"glXCreateContextAttribsARB",
       [](S& s, Call call, Thread&) {
         const bool es = (attribute(call, 4, GLX_CONTEXT_PROFILE_MASK, 0) & GLX_CONTEXT_ES_PROFILE_BIT) != 0;
         s.create_context(
             call, versioned(es ? "OpenGL ES" : "OpenGL", attribute(call, 4, GLX_CONTEXT_MAJOR_VERSION, 1),
                             attribute(call, 4, GLX_CONTEXT_MINOR_VERSION, 0)));
       }},
      {"eglCreatePbufferSurface",
       [](S& s, Call call, Thread&) {
         s.resize(result_handle(call), attribute(call, 2, EGL_WIDTH, 0), attribute(call, 2, EGL_HEIGHT, 0));
       }},
      {"glXCreatePbuffer",
       [](S& s, Call call, Thread&) {
         s.resize(result_handle(call), attribute(call, 2, GLX_PBUFFER_WIDTH, 0),
                  attribute(call, 2, GLX_PBUFFER_HEIGHT, 0));
       }},
      {"eglQuerySurface", [](S& s, Call call, Thread&) { s.query_size(call, EGL_WIDTH, EGL_HEIGHT); }},
      {"glXQueryDrawable", [](S& s, Call call, Thread&) { s.query_size(call, GLX_WIDTH, GLX_HEIGHT); }},
      {"glViewport", [](S& s, Call call, Thread& thread) { s.set_viewport(call, thread); }},
      {"glBindFramebuffer", bind_framebuffer},
      {"glBindFramebufferEXT", bind_framebuffer},
      {"glBindFramebufferOES", bind_framebuffer},
      {"glGetString",
       [](S& s, Call call, Thread&) {
         if (argument(call, 0) == GL_VERSION) s.gl_version_ = call.result.text;
         if (argument(call, 0) == GL_RENDERER) s.gl_renderer_ = call.result.text;
       }},
      {"glGetInteger64v", [](S& s, Call call, Thread&) { s.note_time(call); }},
  };
  return kHandlers;
}

bool TraceSurvey::watches(std::string_view function) {
  return handlers().contains(function);
}

void TraceSurvey::see_function(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, TraceApi>, 6> kPrefixes = {
      {{"egl", TraceApi::kEgl},
       {"glX", TraceApi::kGlx},
       {"wgl", TraceApi::kWgl},
       {"CGL", TraceApi::kCgl},
       {"Direct", TraceApi::kDirect3d},
       {"D3D", TraceApi::kDirect3d}}};
  if (api_ != TraceApi::kUnknown) return;
  for (const auto& [prefix, api] : kPrefixes)
    if (name.starts_with(prefix)) api_ = api;
}

void TraceSurvey::see(const TraceCall& call, const TraceFunction& function) {
  const auto thread = threads_.try_emplace(call.thread).first;
  if (threads_.size() > kMaxHandles) fail_corrupt("too many threads");
  if (!function.watched) return;
  handlers().at(function.name)(*this, call, thread->second);
}

TraceSurface& TraceSurvey::surface(uint64_t id) {
  TraceSurface& surface = surfaces_[id];
  if (surfaces_.size() > kMaxHandles) fail_corrupt("too many surfaces");
  surface.id = id;
  return surface;
}

TraceSurvey::Context& TraceSurvey::context(uint64_t id) {
  Context& context = contexts_[id];
  if (contexts_.size() > kMaxHandles) fail_corrupt("too many contexts");
  return context;
}

void TraceSurvey::present(uint64_t id, Thread& thread) {
  if (id == 0) return;
  ++frames_;
  if (++surface(id).frames == 1) presented_.push_back(id);
  context(thread.context).presented = true;
}

void TraceSurvey::make_current(Thread& thread, uint64_t surface_id, uint64_t context_id,
                               const TraceCall& call) {
  if (call.result.as_number(1) == 0) return;  // the call failed and changed nothing
  thread.surface = surface_id;
  thread.context = context_id;
}

void TraceSurvey::create_context(const TraceCall& call, std::string client_api) {
  if (const uint64_t id = result_handle(call); id != 0) context(id).client_api = std::move(client_api);
}

void TraceSurvey::resize(uint64_t id, int64_t width, int64_t height) {
  constexpr int64_t kMaxSide = 1 << 16;
  if (id == 0 || width <= 0 || height <= 0 || width > kMaxSide || height > kMaxSide) return;
  TraceSurface& target = surface(id);
  target.width = std::max(target.width, static_cast<uint32_t>(width));
  target.height = std::max(target.height, static_cast<uint32_t>(height));
}

void TraceSurvey::query_size(const TraceCall& call, int64_t width_name, int64_t height_name) {
  const int64_t name = argument(call, 2), value = argument(call, 3);
  if (name == width_name) resize(handle(call, 1), value, 1);
  if (name == height_name) resize(handle(call, 1), 1, value);
}

void TraceSurvey::set_viewport(const TraceCall& call, Thread& thread) {
  // The recorder notes the window's size as a viewport when a context becomes current. A retracer sizes its
  // windows by the viewports of the default framebuffer.
  if (context(thread.context).draw_framebuffer != 0) return;
  // A file may have any 64-bit number where GL has 32 bits. The sum of two must not overflow.
  const auto gl_int = [&call](size_t position) {
    return std::clamp<int64_t>(argument(call, position), INT32_MIN, INT32_MAX);
  };
  resize(thread.surface, gl_int(0) + gl_int(2), gl_int(1) + gl_int(3));
}

void TraceSurvey::note_time(const TraceCall& call) {
  if (argument(call, 0) != GL_TIMESTAMP) return;
  last_time_ns_ = argument(call, 1);
  if (first_time_ns_ == 0) first_time_ns_ = last_time_ns_;
}

void TraceSurvey::report(TraceSummary& summary) const {
  summary.api = api_;
  summary.threads = threads_.size();
  summary.frames = frames_;
  for (const uint64_t id : presented_) summary.surfaces.push_back(surfaces_.at(id));
  summary.gl_version = gl_version_;
  summary.gl_renderer = gl_renderer_;
  if (last_time_ns_ > first_time_ns_)
    summary.duration_ns = static_cast<uint64_t>(last_time_ns_) - static_cast<uint64_t>(first_time_ns_);
  std::set<std::string> names;
  for (const auto& [id, context] : contexts_)
    if (context.presented && !context.client_api.empty()) names.insert(context.client_api);
  for (const std::string& name : names) summary.contexts += (summary.contexts.empty() ? "" : ", ") + name;
}

}  // namespace tilepress
