// Private session: binds, reads, binds back, and measures both bindings.
#include "interposer/engine/readback/private_session.h"

#include <memory>

#include "interposer/engine/readback/gl_readback.h"
#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/system_calls.h"

namespace tilepress {
namespace {

Error not_back() {
  return {ErrorKind::kSystem, "the program's context could not be made current again"};
}

bool is_current(const Binding& binding, const Drawable& drawable) {
  return binding.context != nullptr &&
         (binding.draw == drawable.key.surface || binding.read == drawable.key.surface);
}

}  // namespace

Result<void> PrivateSession::read(const TilepressPresent& present, const Drawable& drawable,
                                  CapturedFrame& frame) {
  const Binding program = api_.current();
  const bool in_place = is_current(program, drawable);
  const auto read_here = [&] {
    return read_swapped(program, present, drawable, api_.buffer_of(drawable), frame);
  };
  if (in_context_only_ || !api_.can_come_back(present))
    return in_place ? read_here() : unreadable("the drawable is current nowhere");
  if (in_place && frame.way == ReadWay::kInContext && read_here()) return {};
  if (frame.way == ReadWay::kInContext) frame.way = ReadWay::kSync;
  Result<void> done = read_privately(program, drawable, frame);
  const bool other_way = !done && done.error().kind == ErrorKind::kUnsupported && in_place;
  return other_way ? read_here() : done;
}

Result<void> PrivateSession::read_in_place(const TilepressPresent& present, const Drawable& drawable,
                                           GLenum buffer, CapturedFrame& frame) {
  const Binding program = api_.current();
  if (!is_current(program, drawable)) return unreadable("the drawable is not current");
  return read_swapped(program, present, drawable, buffer, frame);
}

// A read takes from the read drawable. If another drawable is presented, the two change places during the
// read. Both stay current: Mesa drops the buffers of a plain X window that is current nowhere. The context
// stays as well: for another context Mesa would give both drawables new buffers of the size they have by now.
Result<void> PrivateSession::read_swapped(const Binding& program, const TilepressPresent& present,
                                          const Drawable& drawable, GLenum buffer, CapturedFrame& frame) {
  frame.way = ReadWay::kInContext;
  if (drawable.multisampled)
    return unreadable("a multisampled surface is resolved in a private context alone");
  const bool swap = program.read != drawable.key.surface;
  const Binding swapped{program.display, program.read, program.draw, program.context};
  const uint64_t begin_ns = now_ns();
  if (swap && !api_.can_come_back(present))
    return unreadable("the drawable that the program reads from is destroyed");
  if (swap && !api_.bind(swapped)) return unreadable("the drawable cannot be read in the program's context");
  const uint64_t bound_ns = now_ns();
  const bool taken = read_in_program_context(gl_, drawable.shape, buffer, frame);
  const uint64_t taken_ns = now_ns();
  if (swap && !api_.bind(program)) return not_back();
  if (swap) frame.bind_ns = now_ns() - begin_ns - (taken_ns - bound_ns);
  if (!taken) return unreadable("the program's context cannot be read");
  return {};
}

Result<void> PrivateSession::read_privately(Binding program, const Drawable& drawable, CapturedFrame& frame) {
  void* const display = const_cast<void*>(drawable.key.display);
  if (program.context == nullptr) program.display = display;
  const ContextPool::Key key{display, reinterpret_cast<uintptr_t>(drawable.config)};
  const uint64_t begin_ns = now_ns();
  Binding own{display, drawable.key.surface, drawable.key.surface, pool_.take(key)};
  bool bound = own.context != nullptr && api_.bind(own);
  if (!bound) {  // no context is free, or a device reset has lost the free one
    own.context = api_.create_private(drawable, program);
    bound = own.context != nullptr && api_.bind(own);
  }
  const uint64_t bound_ns = now_ns();
  bool taken = false;
  if (bound) {
    const auto twin = [&](TwinContext& made) { return api_.create_twin(drawable, own.context, made); };
    const std::shared_ptr<PixelBuffers> buffers =
        groups_.of_context(own.context, frame.way, gl_, display, reader_, twin);
    taken = read_back_buffer(gl_, drawable.shape, buffers, frame);
  }
  if (taken && frame.late != nullptr) reader_.post(frame);  // before another thread may destroy our context
  const uint64_t taken_ns = now_ns();
  if (bound && !api_.bind(program)) return not_back();
  frame.bind_ns = now_ns() - begin_ns - (taken_ns - bound_ns);
  if (own.context != nullptr) pool_.give(key, own.context);
  if (!taken) return unreadable(bound ? "glReadPixels failed" : "the private context cannot be made current");
  return {};
}

Result<void> PrivateSession::beside(const TilepressPresent& present, const std::function<void()>& work) {
  if (in_context_only_) return unreadable("--readback in-context forbids private contexts");
  if (!api_.can_come_back(present)) return unreadable("the program's context or drawable is destroyed");
  const Binding program = api_.current();
  const ContextPool::Key key{program.display, reinterpret_cast<uintptr_t>(program.context)};
  void* own = sharing_.take(key);
  if (own == nullptr) own = api_.create_sharing(present, program);
  const bool bound = own != nullptr && api_.bind_sharing(program, own);
  if (bound) work();
  const bool back = !bound || api_.bind(program);
  if (own != nullptr) sharing_.give(key, own);
  if (!back) return not_back();
  if (!bound) return unreadable("no private context can share objects with the program's");
  return {};
}

void PrivateSession::leave(void* display, bool destroy) {
  if (!groups_.of_display(display).empty()) reader_.let_go(display);
  for (ContextPool* pool : {&pool_, &sharing_})
    for (void* own : pool->take_all(display)) {
      const std::shared_ptr<PixelBuffers> buffers = groups_.take(own);
      if (!destroy) continue;
      if (buffers != nullptr && buffers->twin() != nullptr) buffers->twin()->destroy();
      api_.destroy(display, own);
    }
}

}  // namespace tilepress
