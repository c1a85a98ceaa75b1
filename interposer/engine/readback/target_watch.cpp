// Target watch: two marks per thread are enough, because only watched calls change what a thread draws to.
#include "interposer/engine/readback/target_watch.h"

#include <GL/glext.h>

#include <algorithm>

namespace tilepress {
namespace {

// A bit per colour attachment of the framebuffer that the thread draws to.
using Points = uint32_t;

thread_local uint8_t drawn = 0;  // drawn to the present draw buffers since they were chosen
thread_local Points kept = 0;    // drawn to before that, and still attached

Points bit_of(GLenum point) {
  return point >= GL_COLOR_ATTACHMENT0 && point < GL_COLOR_ATTACHMENT0 + 32
             ? Points{1} << (point - GL_COLOR_ATTACHMENT0)
             : 0;
}

uint32_t number(const TilepressGlCall& call, int index) {
  return static_cast<uint32_t>(call.arguments[index]);
}

/// The array whose length is the argument at `index`, and whose address is the next argument.
std::vector<uint32_t> list(const TilepressGlCall& call, int index) {
  const auto count = static_cast<int32_t>(number(call, index));
  const auto* first = reinterpret_cast<const uint32_t*>(call.arguments[index + 1]);
  if (count <= 0 || first == nullptr) return {};
  return {first, first + count};
}

bool holds(const std::vector<uint32_t>& names, uint32_t name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class DrawnFramebuffer {
 public:
  explicit DrawnFramebuffer(const GlFunctions& gl)
      : gl_(gl),
        version_(version_of(gl)),
        name_(bound_framebuffer(gl, version_, FramebufferUse::kDraw)),
        points_(name_ != 0 ? kept : 0) {
    if (name_ != 0 && drawn != 0)
      for (const GLenum point : buffers_in_use(gl, version_, FramebufferUse::kDraw)) points_ |= bit_of(point);
  }

  GLuint name() const { return name_; }
  Points points() const { return points_; }

  std::vector<Attachment> attachments(Points points) const {
    std::vector<Attachment> found;
    if (points == 0 || !is_complete(gl_, version_, FramebufferUse::kDraw)) return found;
    for (GLenum i = 0; i < 32; ++i) {
      Attachment attachment;
      if ((points >> i & 1) != 0 &&
          describe_attachment(gl_, version_, FramebufferUse::kDraw, GL_COLOR_ATTACHMENT0 + i, attachment))
        found.push_back(attachment);
    }
    return found;
  }

  /// The drawn points that these images are attached to.
  Points points_of(bool textures, const std::vector<uint32_t>& names) const {
    Points points = 0;
    for (const Attachment& attachment : attachments(points_))
      if (attachment.texture == textures && holds(names, attachment.name)) points |= bit_of(attachment.point);
    return points;
  }

  /// The points of the image that a call like glTexImage2D is about to replace.
  Points points_respecified(GLenum target) const {
    const bool texture = target != GL_RENDERBUFFER;
    const GLenum question = !texture                  ? GL_RENDERBUFFER_BINDING
                            : target == GL_TEXTURE_2D ? GL_TEXTURE_BINDING_2D
                                                      : GL_TEXTURE_BINDING_CUBE_MAP;
    const bool cube = target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z;
    if (texture && target != GL_TEXTURE_2D && !cube && target != GL_TEXTURE_CUBE_MAP) return 0;
    GLint name = 0;
    gl_.GetIntegerv(question, &name);
    return points_of(texture, {static_cast<uint32_t>(name)});
  }

 private:
  const GlFunctions& gl_;
  const ContextVersion version_;
  const GLuint name_;
  Points points_;
};

/// Returns the images at `leaving`, and goes on with the marks at `staying`.
std::vector<Attachment> leave(const DrawnFramebuffer& framebuffer, Points leaving, Points staying) {
  std::vector<Attachment> left = framebuffer.attachments(leaving);
  drawn = 0;
  kept = staying;
  return left;
}

std::vector<Attachment> leave(const DrawnFramebuffer& framebuffer, Points leaving) {
  return leave(framebuffer, leaving, framebuffer.points() & ~leaving);
}

}  // namespace

uint8_t* drawn_mark() {
  return &drawn;
}

bool concerns_targets(const TilepressGlCall& call) {
  if (call.kind == TILEPRESS_GL_CLEAR && (number(call, 0) & GL_COLOR_BUFFER_BIT) != 0) drawn = 1;
  if (call.kind == TILEPRESS_GL_CLEAR_BUFFER && number(call, 0) == GL_COLOR) drawn = 1;
  if (call.kind == TILEPRESS_GL_CLEAR || call.kind == TILEPRESS_GL_CLEAR_BUFFER) return false;
  return drawn != 0 || kept != 0;
}

std::vector<Attachment> targets_left_by(const GlFunctions& gl, const TilepressGlCall& call,
                                        const void* context) {
  const bool names_target = call.kind == TILEPRESS_GL_BIND_FRAMEBUFFER || call.kind == TILEPRESS_GL_ATTACH ||
                            call.kind == TILEPRESS_GL_INVALIDATE;
  if (names_target && number(call, 0) == GL_READ_FRAMEBUFFER) return {};
  const DrawnFramebuffer now(gl);
  switch (call.kind) {
    case TILEPRESS_GL_BIND_FRAMEBUFFER:
      return number(call, 1) != now.name() ? leave(now, now.points()) : std::vector<Attachment>();
    case TILEPRESS_GL_MAKE_CURRENT:
    case TILEPRESS_GL_MAKE_CURRENT_3: {
      const int argument = call.kind == TILEPRESS_GL_MAKE_CURRENT ? 3 : 2;
      const bool same = reinterpret_cast<const void*>(call.arguments[argument]) == context;
      return same ? std::vector<Attachment>() : leave(now, now.points());
    }
    default:
      break;
  }
  if (now.name() == 0) return {};
  switch (call.kind) {
    case TILEPRESS_GL_DELETE_FRAMEBUFFERS:
      return holds(list(call, 0), now.name()) ? leave(now, now.points()) : std::vector<Attachment>();
    case TILEPRESS_GL_DELETE_TEXTURES:
    case TILEPRESS_GL_DELETE_RENDERBUFFERS:
      return leave(now, now.points_of(call.kind == TILEPRESS_GL_DELETE_TEXTURES, list(call, 0)));
    case TILEPRESS_GL_DRAW_BUFFER:
      return leave(now, now.points() & ~bit_of(number(call, 0)));
    case TILEPRESS_GL_DRAW_BUFFERS: {
      Points chosen = 0;
      for (const uint32_t point : list(call, 0)) chosen |= bit_of(point);
      return leave(now, now.points() & ~chosen);
    }
    case TILEPRESS_GL_ATTACH:
      return leave(now, now.points() & bit_of(number(call, 1)));
    case TILEPRESS_GL_INVALIDATE: {
      Points dropped = 0;
      for (const uint32_t point : list(call, 1)) dropped |= bit_of(point);
      return leave(now, 0, now.points() & ~dropped);
    }
    case TILEPRESS_GL_RESPECIFY:
      return leave(now, now.points_respecified(number(call, 0)));
    default:
      return {};
  }
}

std::vector<Attachment> targets_left(const GlFunctions& gl) {
  if (drawn == 0 && kept == 0) return {};
  const DrawnFramebuffer now(gl);
  return leave(now, now.points());
}

}  // namespace tilepress
