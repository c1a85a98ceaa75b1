// Neutral read state: against a made-up GL that knows exactly the states of one version and its extensions:
// also those of the table that no driver here has.
#include "interposer/engine/readback/neutral_read_state.h"

#include <GL/glext.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tilepress {
namespace {

constexpr GLfloat kHostile = 5;  // no state's neutral value

struct MadeUp {
  std::string version, extensions;
  std::vector<std::string> listed;  // of a core profile
  GLint profile = 0;
  std::set<GLenum> known;  // every other name is an error
  std::map<GLenum, GLfloat> values;
  std::array<GLfloat, 16> color_matrix;
  GLenum matrix_mode = GL_TEXTURE;
  int errors = 0;

  bool has(GLenum name) {
    if (!known.contains(name)) ++errors;
    return known.contains(name);
  }
} made_up;

void set(GLenum name, GLfloat value) {
  if (made_up.has(name)) made_up.values[name] = value;
}

GlFunctions functions() {
  GlFunctions gl;
  gl.GetString = [](GLenum name) {
    const std::string& text = name == GL_VERSION ? made_up.version : made_up.extensions;
    if (name == GL_EXTENSIONS && !made_up.listed.empty()) ++made_up.errors;
    return reinterpret_cast<const GLubyte*>(text.c_str());
  };
  gl.GetStringi = [](GLenum, GLuint i) {
    return reinterpret_cast<const GLubyte*>(made_up.listed.at(i).c_str());
  };
  gl.GetIntegerv = [](GLenum name, GLint* value) {
    if (name == GL_CONTEXT_PROFILE_MASK)
      *value = made_up.profile;
    else if (name == GL_NUM_EXTENSIONS)
      *value = static_cast<GLint>(made_up.listed.size());
    else if (name == GL_CONTEXT_FLAGS)
      *value = 0;
    else if (name == GL_MATRIX_MODE)
      *value = static_cast<GLint>(made_up.matrix_mode);
    else if (made_up.has(name))
      *value = static_cast<GLint>(made_up.values[name]);
  };
  gl.GetFloatv = [](GLenum name, GLfloat* value) {
    if (!made_up.has(name)) return;
    if (name == GL_COLOR_MATRIX)
      std::copy(made_up.color_matrix.begin(), made_up.color_matrix.end(), value);
    else
      *value = made_up.values[name];
  };
  gl.IsEnabled = [](GLenum name) -> GLboolean { return made_up.has(name) && made_up.values[name] != 0; };
  gl.Enable = [](GLenum name) { set(name, kHostile); };
  gl.Disable = [](GLenum name) { set(name, 0); };
  gl.PixelStorei = [](GLenum name, GLint value) { set(name, static_cast<GLfloat>(value)); };
  gl.PixelTransferi = gl.PixelStorei;
  gl.PixelTransferf = set;
  gl.ClampColor = [](GLenum name, GLenum value) { set(name, static_cast<GLfloat>(value)); };
  gl.ReadBuffer = [](GLenum value) { set(GL_READ_BUFFER, static_cast<GLfloat>(value)); };
  gl.ReadBufferNV = gl.ReadBuffer;
  gl.BindBuffer = [](GLenum, GLuint name) { set(GL_PIXEL_PACK_BUFFER_BINDING, static_cast<GLfloat>(name)); };
  gl.BindFramebuffer = [](GLenum target, GLuint name) {
    set(target == GL_READ_FRAMEBUFFER ? GL_READ_FRAMEBUFFER_BINDING : GL_FRAMEBUFFER_BINDING,
        static_cast<GLfloat>(name));
  };
  gl.BindFramebufferEXT = gl.BindFramebufferOES = gl.BindFramebuffer;
  gl.CheckFramebufferStatus = [](GLenum) -> GLenum { return GL_FRAMEBUFFER_COMPLETE; };
  gl.GetFramebufferAttachmentParameteriv = [](GLenum, GLenum, GLenum, GLint*) {};
  gl.MatrixMode = [](GLenum mode) { made_up.matrix_mode = mode; };
  gl.LoadMatrixf = [](const GLfloat* values) {
    if (made_up.matrix_mode != GL_COLOR) ++made_up.errors;
    std::copy(values, values + 16, made_up.color_matrix.begin());
  };
  return gl;
}

/// A context in which all rows that `has` are known, and hostile.
template <typename Has>
size_t make_hostile(const char* version, const Has& has) {
  made_up = {};
  made_up.version = version;
  made_up.color_matrix.fill(kHostile);
  size_t count = 0;
  for (const read_state& state : kReadStates) {
    if (!has(state)) continue;
    ++count;
    made_up.known.insert(state.gl_name);
    if (state.kind == kReadFramebuffer) made_up.known.insert(GL_FRAMEBUFFER_BINDING);
    made_up.values[state.gl_name] = state.kind == kReadDisplayList ? 0 : kHostile;
    made_up.values[GL_FRAMEBUFFER_BINDING] = kHostile;
    if (*state.extensions != 0) made_up.extensions.append(state.extensions).append(" ");
  }
  return count;
}

GLfloat neutral_value(const read_state& state) {
  return state.kind == kReadFramebuffer ? 7
         : state.kind == kReadBuffer    ? static_cast<GLfloat>(GL_BACK)
                                        : static_cast<GLfloat>(state.neutral);
}

/// Every known state is neutral while it lives, and as it was afterwards; nothing else was asked for or set.
void expect_neutral_meanwhile() {
  const GlFunctions gl = functions();
  const auto before = made_up.values;
  const auto matrix = made_up.color_matrix;
  {
    const NeutralReadState neutral(gl, version_of(gl), 7, GL_BACK);
    EXPECT_TRUE(neutral.whole());
    for (const read_state& state : kReadStates) {
      if (!made_up.known.contains(state.gl_name)) continue;
      if (state.kind == kReadColorMatrix) {
        for (size_t i = 0; i < 16; ++i) EXPECT_EQ(made_up.color_matrix[i], i % 5 == 0 ? 1 : 0);
      } else {
        EXPECT_EQ(made_up.values[state.gl_name], neutral_value(state)) << state.name;
      }
    }
  }
  EXPECT_EQ(made_up.values, before);
  EXPECT_EQ(made_up.color_matrix, matrix);
  EXPECT_EQ(made_up.matrix_mode, GLenum{GL_TEXTURE});
  EXPECT_EQ(made_up.errors, 0);
}

TEST(NeutralReadState, HoldsForEveryRowWhereAllExtensionsAre) {
  const size_t count = make_hostile("4.6 (Compatibility Profile)", [](const read_state&) { return true; });
  EXPECT_EQ(count, size_t{kReadStateCount});
  expect_neutral_meanwhile();
}

TEST(NeutralReadState, AsksACoreProfileForNothingThatItLacks) {
  make_hostile("4.6", [](const read_state& state) { return state.legacy == 0 && state.desktop != 0; });
  made_up.profile = GL_CONTEXT_CORE_PROFILE_BIT;
  made_up.listed = {"GL_ARB_robustness", "GL_MESA_pack_invert"};
  made_up.known.insert(GL_PACK_INVERT_MESA);
  made_up.values[GL_PACK_INVERT_MESA] = 1;
  expect_neutral_meanwhile();
}

TEST(NeutralReadState, AsksEachVersionForWhatItHas) {
  for (const auto& [version, number] :
       {std::pair{"1.1", 11}, {"1.5", 15}, {"2.1", 21}, {"3.0", 30}, {"4.2", 42}}) {
    SCOPED_TRACE(version);
    make_hostile(version,
                 [&](const read_state& state) { return state.desktop != 0 && state.desktop <= number; });
    made_up.extensions = "GL_ARB_imaginary";
    expect_neutral_meanwhile();
  }
  for (const auto& [version, number] : {std::pair{"OpenGL ES-CM 1.1", 11},
                                        {"OpenGL ES 2.0", 20},
                                        {"OpenGL ES 3.0", 30},
                                        {"OpenGL ES 3.2", 32}}) {
    SCOPED_TRACE(version);
    make_hostile(version,
                 [&](const read_state& state) { return state.embedded != 0 && state.embedded <= number; });
    made_up.extensions = "";
    if (number == 20) made_up.known.erase(GL_READ_FRAMEBUFFER_BINDING);
    expect_neutral_meanwhile();
  }
}

TEST(NeutralReadState, GivesUpWhereSettersGoIntoADisplayList) {
  const GlFunctions gl = functions();
  for (const bool needs_setter : {false, true}) {
    make_hostile("2.1", [](const read_state& state) { return state.desktop != 0 && state.desktop <= 21; });
    made_up.extensions = "";
    for (const read_state& state : kReadStates)
      if (state.kind != kReadPack && state.kind != kReadPackBuffer)
        made_up.values[state.gl_name] = neutral_value(state);
    made_up.values[GL_LIST_INDEX] = 3;
    if (needs_setter) made_up.values[GL_RED_SCALE] = kHostile;
    const auto before = made_up.values;
    {
      const NeutralReadState neutral(gl, version_of(gl), 0, GL_BACK);
      EXPECT_EQ(neutral.whole(), !needs_setter);
      EXPECT_EQ(made_up.values[GL_RED_SCALE], needs_setter ? kHostile : 1);
    }
    EXPECT_EQ(made_up.values, before);
  }
}

}  // namespace
}  // namespace tilepress
