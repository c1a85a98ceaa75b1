// Source list: a call through a driver's own road is answered by the driver, others by the public libraries.
#include "interposer/engine/source_list.h"

#include <dlfcn.h>

namespace tilepress {

static const char* swap_of(uint32_t api) {
  return api == TILEPRESS_EGL ? "eglSwapBuffers" : "glXSwapBuffers";
}

PresentSource* SourceList::of(const TilepressPresent& present) {
  static constexpr decltype(&make_egl_source) kMake[] = {make_egl_source, make_glx_source,
                                                         make_osmesa_source};
  const std::lock_guard lock(mutex_);
  for (const Known& known : known_)
    if (known.real == present.real) return known.source.get();
  const SourceSettings settings{host_, reader_, in_context_only_};
  known_.push_back({present.real, present.api, kMake[present.api](settings, present)});
  PresentSource* made = known_.back().source.get();
  if (made == nullptr) log_.error("the GL library lacks functions to read frames back");
  return made;
}

/// The presenting function of the library that programs call, if that library is loaded.
void* SourceList::public_function(uint32_t api) {
  if (void* known = public_[api]) return known;
  static constexpr const char* kLibraries[][2] = {{"libEGL.so.1", nullptr}, {"libGLX.so.0", "libGL.so.1"}};
  for (const char* library : kLibraries[api]) {
    void* handle = library != nullptr ? dlopen(library, RTLD_LAZY | RTLD_NOLOAD) : nullptr;
    if (handle == nullptr) continue;
    public_[api] = host_.dlsym(handle, swap_of(api));
    dlclose(handle);
    if (void* found = public_[api]) return found;
  }
  dlerror();
  return nullptr;
}

PresentSource* SourceList::of_current(const TilepressGlCall& call, FramebufferUse use,
                                      TilepressPresent& present) {
  present = {};
  present.road = call.road;
  present.context_destroyed = call.context_destroyed;
  const auto current = [&](uint32_t api, void* real) -> PresentSource* {
    present.api = api;
    present.real = real;
    present.look_up = call.look_up[api];
    PresentSource* source = real != nullptr ? of(present) : nullptr;
    return source != nullptr && source->find_current(present, use) ? source : nullptr;
  };
  if (PresentSource* source = current(TILEPRESS_OSMESA, call.osmesa)) return source;
  const bool driver = call.look_up[TILEPRESS_EGL] != nullptr || call.look_up[TILEPRESS_GLX] != nullptr;
  for (const uint32_t api : {TILEPRESS_EGL, TILEPRESS_GLX}) {
    const auto look_up = call.look_up[api];
    void* real = nullptr;
    if (look_up != nullptr)
      real = look_up(swap_of(api));
    else if (!driver)
      real = public_function(api);
    if (PresentSource* source = current(api, real)) return source;
  }
  return nullptr;
}

void SourceList::release(uint32_t api, void* display) {
  const std::lock_guard lock(mutex_);
  for (const Known& known : known_)
    if (known.api == api && known.source != nullptr) known.source->release(display);
}

void SourceList::trim(void* display) {
  const std::lock_guard lock(mutex_);
  for (const Known& known : known_)
    if (known.source != nullptr) known.source->trim(display);
}

}  // namespace tilepress
