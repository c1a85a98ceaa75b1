// Neutral read state: sets every state that a read heeds to its neutral value, and puts back the program's
// values.
#pragma once

#include <array>

#include "interposer/engine/readback/read_states.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/gl_functions.h"

namespace tilepress {

/// Works in the program's context, which is current. Queries and sets only what this context has, so no call
/// raises an error.
class NeutralReadState {
 public:
  /// Reads take `buffer` of framebuffer object `framebuffer`; 0 is the default framebuffer.
  NeutralReadState(const GlFunctions& gl, const ContextVersion& version, GLuint framebuffer, GLenum buffer);
  ~NeutralReadState();
  NeutralReadState(const NeutralReadState&) = delete;
  NeutralReadState& operator=(const NeutralReadState&) = delete;

  /// False if some state cannot be made neutral: its function is missing, or the program compiles a display
  /// list, which would record the setter.
  bool whole() const { return whole_; }

 private:
  struct Saved {
    const read_state* state;
    GLint value;
    GLfloat real;
  };
  /// Fills in the program's value.
  bool is_neutral(Saved& saved);
  /// Returns false if a function is missing.
  bool set(const read_state& state, GLint value, GLfloat real, const GLfloat* matrix) const;

  const GlFunctions& gl_;
  const ContextVersion version_;
  const GLuint framebuffer_;
  const GLenum buffer_;
  bool whole_ = true;
  size_t saved_count_ = 0;
  std::array<Saved, kReadStateCount> saved_;
  GLfloat color_matrix_[16] = {};
};

}  // namespace tilepress
