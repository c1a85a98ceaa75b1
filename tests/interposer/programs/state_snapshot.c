/* state_snapshot es2|es3|gl [finish]: sets awkward state, swaps, and prints every state that can be asked
   for, before and after, and every error flag. With and without the shim it prints the same text. "Every
   state": all enums below 0xA000 that glGetIntegerv accepts, asked by trying. */
#define GL_GLEXT_PROTOTYPES
#include "egl_session.h"

#include <GLES3/gl32.h>
#include <stdio.h>
#include <string.h>

enum { kEnums = 0x9590, kValues = 16, kSentinel = 0x5EED5EED };

/* Times and memory sizes change by themselves. */
static int is_volatile(unsigned name) {
  return name == 0x8E28 || (name >= 0x9047 && name <= 0x904B) || name == 0x87FC;
}

static void print_state(const char* when) {
  for (unsigned name = 1; name < kEnums; ++name) {
    GLint values[kValues * 16];
    for (int i = 0; i < kValues * 16; ++i) values[i] = kSentinel;
    if (is_volatile(name)) continue;
    glGetIntegerv(name, values);
    if (glGetError() != GL_NO_ERROR) continue;
    printf("%s 0x%04x", when, name);
    for (int i = 0; i < kValues && values[i] != kSentinel; ++i) printf(" %d", values[i]);
    printf("\n");
  }
}

static void print_egl(const char* when, EGLDisplay display, EGLSurface surface, EGLContext context) {
  const EGLint surface_names[] = {EGL_WIDTH,        EGL_HEIGHT,    EGL_SWAP_BEHAVIOR,      EGL_RENDER_BUFFER,
                                  EGL_MIPMAP_LEVEL, EGL_CONFIG_ID, EGL_MULTISAMPLE_RESOLVE};
  printf("%s api 0x%x current %d %d %d %d\n", when, eglQueryAPI(), eglGetCurrentContext() == context,
         eglGetCurrentDisplay() == display, eglGetCurrentSurface(EGL_DRAW) == surface,
         eglGetCurrentSurface(EGL_READ) == surface);
  for (unsigned i = 0; i < sizeof surface_names / sizeof *surface_names; ++i) {
    EGLint value = -1;
    const EGLBoolean known = eglQuerySurface(display, surface, surface_names[i], &value);
    printf("%s surface 0x%x %u %d 0x%x\n", when, (unsigned)surface_names[i], known, value,
           (unsigned)eglGetError());
  }
}

/* What real programs leave behind at a swap, and worse. */
static void set_awkward_state(int es2, int desktop) {
  GLuint names[4];
  glGenTextures(1, names);
  glBindTexture(GL_TEXTURE_2D, names[0]);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
  glGenFramebuffers(1, names + 1);
  glBindFramebuffer(GL_FRAMEBUFFER, names[1]);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[0], 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glPixelStorei(GL_PACK_ALIGNMENT, 8);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glViewport(3, 4, 5, 6);
  glEnable(GL_BLEND);
  glColorMask(1, 0, 1, 0);
  if (es2) return;
  glEnable(GL_DEBUG_OUTPUT);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glGenBuffers(1, names + 2);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, names[2]);
  glBufferData(GL_PIXEL_PACK_BUFFER, 64, NULL, GL_STREAM_READ);
  glPixelStorei(GL_PACK_ROW_LENGTH, 100);
  glPixelStorei(GL_PACK_SKIP_ROWS, 7);
  glPixelStorei(GL_PACK_SKIP_PIXELS, 3);
  if (desktop) glPixelStorei(0x0D00 /* GL_PACK_SWAP_BYTES */, 1);
  if (desktop) glPixelStorei(0x806C /* GL_PACK_IMAGE_HEIGHT */, 9);
  glGenQueries(1, names + 3);
  glBeginQuery(GL_ANY_SAMPLES_PASSED, names[3]);
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const int es2 = strcmp(argv[1], "es2") == 0, desktop = strcmp(argv[1], "gl") == 0;
  const channel_bits bits = {8, 8, 8, 8, 0};
  EGLDisplay display = open_surfaceless();
  EGLConfig config = exact_config(display, bits);
  EGLSurface surface = make_pbuffer(display, config, 33, 21);
  if (desktop) eglBindAPI(EGL_OPENGL_API);
  EGLContext context = desktop ? eglCreateContext(display, config, EGL_NO_CONTEXT, NULL)
                               : make_context(display, config, es2 ? 2 : 3);
  if (!eglMakeCurrent(display, surface, surface, context)) return 9;
  for (unsigned frame = 0; frame < 3; ++frame) {
    if (frame > 0) glBindFramebuffer(es2 ? GL_FRAMEBUFFER : GL_DRAW_FRAMEBUFFER, 0);
    draw_known_picture(&kLinkedGl, frame, 33, 21);
    if (frame == 0) set_awkward_state(es2, desktop);
    print_state("before");
    print_egl("before", display, surface, context);
    glEnable(0xBAD);  // an error the program has not asked for yet
    if (argc > 2) glFinish();
    const EGLBoolean result = eglSwapBuffers(display, surface);
    printf("swap %u 0x%x\n", result, (unsigned)eglGetError());
    const GLenum pending = glGetError(), then = glGetError();
    printf("pending error 0x%x then 0x%x\n", pending, then);
    print_state("after");
    print_egl("after", display, surface, context);
    glColorMask(1, 1, 1, 1);
    glDisable(GL_BLEND);
  }
  return 0;
}
