// Neutral read state: sets every state that a read heeds to its neutral value, and puts back what the program
// set.
#pragma once

#include <array>

#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/readback/read_states.h"

namespace tilepress {

/// In the current, foreign context. Asks for and sets only what this context has, so no call raises an error.
class NeutralReadState {
 public:
  /// Reads come from `buffer` of framebuffer object `framebuffer`, 0 = the default framebuffer.
  NeutralReadState(const GlFunctions& gl, const ContextVersion& version, GLuint framebuffer, GLenum buffer);
  ~NeutralReadState();
  NeutralReadState(const NeutralReadState&) = delete;
  NeutralReadState& operator=(const NeutralReadState&) = delete;

  /// False if some state cannot be made neutral: the function is missing, or the program compiles a display
  /// list, which the setter would go into.
  bool whole() const { return whole_; }

 private:
  struct Saved {
    const read_state* state;
    GLint value;
    GLfloat real;
  };
  /// Fills in what the program has set.
  bool is_neutral(Saved& saved);
  bool can_set(const read_state& state) const;
  void set_neutral(const read_state& state);
  void put_back(const Saved& saved);
  bool set(const read_state& state, GLint value, GLfloat real, const GLfloat* matrix) const;
  void (*read_buffer_function() const)(GLenum);

  const GlFunctions& gl_;
  const ContextVersion version_;
  const GLuint framebuffer_;
  const GLenum buffer_;
  bool whole_ = true, compiling_ = false;
  size_t saved_count_ = 0;
  std::array<Saved, kReadStateCount> saved_;
  GLfloat color_matrix_[16] = {};
};

}  // namespace tilepress
