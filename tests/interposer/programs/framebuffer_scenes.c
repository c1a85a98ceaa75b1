/* framebuffer_scenes API SCENE [FRAMES]: programs that draw to framebuffer objects of their own. API: es2,
 * es3, gl (by EGL), glx. Each scene is a function below; every image holds the known picture, so that the
 * tests know its pixels. */
#define GL_GLEXT_PROTOTYPES
#include "covering_triangle.h"
#include "egl_session.h"

#include <GL/glx.h>
#include <GLES3/gl32.h>
#include <stdio.h>
#include <string.h>

enum { kWidth = 33, kHeight = 21 };

static EGLDisplay display;
static EGLSurface window;
static int frames = 4;
static int es2;
static Display* x_display; /* with GLX, else null */
static Window x_window;

static GLuint make_texture(GLenum internal, int width, int height) {
  GLuint name;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  const GLenum format = es2 ? GL_RGBA : internal;
  glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0, GL_RGBA,
               internal == GL_RGBA16F ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE, NULL);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  return name;
}

static GLuint make_framebuffer(GLuint texture) {
  GLuint name;
  glGenFramebuffers(1, &name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  if (texture != 0) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  return name;
}

static void draw(unsigned frame, int width, int height) {
  draw_known_picture(&kLinkedGl, frame, width, height);
}

static void draw_window_and_swap(unsigned frame) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  draw(frame, kWidth, kHeight);
  if (x_display != NULL)
    glXSwapBuffers(x_display, x_window);
  else if (!eglSwapBuffers(display, window))
    exit(8);
}

/* The same window and context by GLX, in place of EGL's. */
static void open_glx(void) {
  x_display = XOpenDisplay(NULL);
  if (x_display == NULL) exit(9);
  const int wanted[] = {GLX_RED_SIZE,     8,    GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_ALPHA_SIZE, 8,
                        GLX_DOUBLEBUFFER, True, GLX_SAMPLES,    0, None};
  int count = 0;
  GLXFBConfig* configs = glXChooseFBConfig(x_display, DefaultScreen(x_display), wanted, &count);
  XVisualInfo* visual = count > 0 ? glXGetVisualFromFBConfig(x_display, configs[0]) : NULL;
  if (visual == NULL) exit(77);
  const Window root = DefaultRootWindow(x_display);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(x_display, root, visual->visual, AllocNone)};
  x_window = XCreateWindow(x_display, root, 0, 0, kWidth, kHeight, 0, visual->depth, InputOutput,
                           visual->visual, CWColormap | CWBorderPixel, &attributes);
  XMapWindow(x_display, x_window);
  XSync(x_display, False);
  GLXContext context = glXCreateNewContext(x_display, configs[0], GLX_RGBA_TYPE, NULL, True);
  if (!glXMakeCurrent(x_display, x_window, context)) exit(9);
}

/* A second context that shares nothing, made current by turns: the first turns away by glXMakeCurrent. */
static void glx_contexts(void) {
  int id = 0, count = 0;
  GLXContext context[2] = {glXGetCurrentContext()};
  glXQueryContext(x_display, context[0], GLX_FBCONFIG_ID, &id);
  const int wanted[] = {GLX_FBCONFIG_ID, id, None};
  GLXFBConfig* configs = glXChooseFBConfig(x_display, DefaultScreen(x_display), wanted, &count);
  if (count == 0) exit(77);
  context[1] = glXCreateNewContext(x_display, configs[0], GLX_RGBA_TYPE, NULL, True);
  GLuint framebuffer[2];
  for (int i = 0; i < 2; ++i) {
    glXMakeCurrent(x_display, x_window, context[i]);
    framebuffer[i] = make_framebuffer(make_texture(GL_RGBA8, 24 + 8 * i, 24));
  }
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame)
    for (int i = 0; i < 2; ++i) {
      if (i == 0)
        glXMakeCurrent(x_display, x_window, context[i]);
      else
        glXMakeContextCurrent(x_display, x_window, x_window, context[i]);
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer[i]);
      draw(frame, 24 + 8 * i, 24);
    }
  draw_window_and_swap(0);
}

/* One texture, then the window. The framebuffer is bound twice, which turns away from nothing. */
static void single(void) {
  const GLuint framebuffer = make_framebuffer(make_texture(GL_RGBA8, 40, 24));
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    draw(frame, 40, 24);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    draw_window_and_swap(frame);
  }
}

/* Two colour attachments drawn at once, with pictures of their own by glClearBufferfv. */
static void mrt(void) {
  const GLuint framebuffer = make_framebuffer(make_texture(GL_RGBA8, 40, 24));
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, make_texture(GL_RGBA8, 40, 24),
                         0);
  const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  const GLenum second[] = {GL_NONE, GL_COLOR_ATTACHMENT1};
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glDrawBuffers(2, both);
    draw(frame, 40, 24);
    glDrawBuffers(2, second); /* turns away from the first */
    draw(frame + 100, 40, 24);
    draw_window_and_swap(frame);
  }
}

/* Two framebuffers by turns, each drawn several times a frame. */
static void pingpong(void) {
  const GLuint first = make_framebuffer(make_texture(GL_RGBA8, 24, 24));
  const GLuint second = make_framebuffer(make_texture(GL_RGBA8, 24, 24));
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, frame % 2 == 0 ? first : second);
    draw(frame / 2, 24, 24);
  }
  draw_window_and_swap(0);
}

/* The framebuffer and its texture are deleted and made again: the same names, another surface. */
static void recreate(void) {
  for (unsigned round = 0; round < 3; ++round) {
    GLuint texture = make_texture(GL_RGBA8, 24, 16), framebuffer = make_framebuffer(texture);
    printf("texture %u framebuffer %u\n", texture, framebuffer);
    for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
      draw(frame, 24, 16);
      if (frame + 1 < (unsigned)frames) glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    if (round == 0) glDeleteFramebuffers(1, &framebuffer); /* turns away from what was drawn last */
    glDeleteTextures(1, &texture);                         /* so does this */
    if (round != 0) glDeleteFramebuffers(1, &framebuffer);
  }
  draw_window_and_swap(0);
}

/* The texture is respecified at another size, while it is attached and drawn. */
static void resize(void) {
  const GLuint texture = make_texture(GL_RGBA8, 24, 16), framebuffer = make_framebuffer(texture);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    const int width = 24 + 8 * (int)(frame / 2);
    if (frame % 2 == 0)
      glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    draw(frame % 2, width, 16);
    if (frame % 2 == 0) glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (frame % 2 == 0) glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  }
  draw_window_and_swap(0);
}

/* Renderbuffers, one of them multisampled. */
static void renderbuffers(void) {
  GLuint names[2];
  glGenRenderbuffers(2, names);
  const GLuint framebuffer = make_framebuffer(0);
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glBindRenderbuffer(GL_RENDERBUFFER, names[0]);
    if (frame == 0) glRenderbufferStorage(GL_RENDERBUFFER, es2 ? GL_RGB565 : GL_RGBA8, 40, 24);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[0]);
    draw(frame, 40, 24);
    if (!es2) {
      glBindRenderbuffer(GL_RENDERBUFFER, names[1]);
      if (frame == 0) glRenderbufferStorageMultisample(GL_RENDERBUFFER, 4, GL_RGBA8, 32, 24);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[1]);
      draw(frame, 32, 24);
    }
    draw_window_and_swap(frame);
  }
}

/* Multisampled images: a renderbuffer, a texture, arrays of one layer and of three. The program resolves each
   as well and prints what it gets, frame by frame, under a scissor that a blit obeys. */
static void multisampled(void) {
  GLuint storage[2], texture[3];
  glGenRenderbuffers(2, storage);
  glGenTextures(3, texture);
  const GLuint framebuffer = make_framebuffer(0), resolved = make_framebuffer(0);
  glBindRenderbuffer(GL_RENDERBUFFER, storage[1]);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 40, 24);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, storage[1]);
  glBindRenderbuffer(GL_RENDERBUFFER, storage[0]);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, 4, GL_RGBA8, 40, 24);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture[0]);
  glTexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, 4, GL_RGBA8, 40, 24, GL_TRUE);
  for (int array = 1; array < 3; ++array) {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, texture[array]);
    glTexStorage3DMultisample(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 4, GL_RGBA8, 40, 24, array == 1 ? 1 : 3,
                              GL_TRUE);
  }
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame)
    for (unsigned image = 0; image < 4; ++image) {
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
      if (image == 0)
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, storage[0]);
      if (image == 1)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, texture[0],
                               0);
      if (image >= 2)
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture[image - 1], 0, image == 3);
      glViewport(0, 0, 40, 24);
      draw_covering_triangle(frame + image);
      glEnable(GL_SCISSOR_TEST);
      glScissor(1, 2, 3, 4);
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      glDisable(GL_SCISSOR_TEST);
      glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
      glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
      glBlitFramebuffer(0, 0, 40, 24, 0, 0, 40, 24, GL_COLOR_BUFFER_BIT, GL_NEAREST);
      glBindFramebuffer(GL_FRAMEBUFFER, resolved);
      print_pixels(40, 24);
    }
  draw_window_and_swap(0);
}

/* A face of a cube map, a layer of an array, a level of a mipmap. */
static void parts(void) {
  GLuint names[3];
  glGenTextures(3, names);
  glBindTexture(GL_TEXTURE_CUBE_MAP, names[0]);
  for (GLenum face = 0; face < 6; ++face)
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA, 24, 24, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 NULL);
  glBindTexture(GL_TEXTURE_2D_ARRAY, names[1]);
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA8, 32, 24, 4);
  glBindTexture(GL_TEXTURE_2D, names[2]);
  glTexStorage2D(GL_TEXTURE_2D, 3, GL_RGBA8, 80, 48);
  GLuint framebuffer = make_framebuffer(0);
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_CUBE_MAP_POSITIVE_X + 3, names[0],
                           0);
    draw(frame, 24, 24);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, names[1], 0, 2);
    draw(frame, 32, 24);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[2], 1);
    draw(frame, 40, 24);
    draw_window_and_swap(frame);
  }
}

/* An invalidated image is never written to memory. */
static void invalidate(void) {
  const GLuint framebuffer = make_framebuffer(make_texture(GL_RGBA8, 40, 24));
  const GLenum point = GL_COLOR_ATTACHMENT0;
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    draw(frame, 40, 24);
    glInvalidateFramebuffer(GL_FRAMEBUFFER, 1, &point);
    draw_window_and_swap(frame);
  }
}

/* Values as memory keeps them, written by scissored clears. OpenGL ES encodes them. */
static void formats(void) {
  const GLuint encoded = make_framebuffer(make_texture(GL_SRGB8_ALPHA8, 40, 24));
  const GLuint floats = make_framebuffer(make_texture(GL_RGBA16F, 16, 16));
  static unsigned char pixels[40 * 24 * 4];
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, floats);
    draw(frame, 16, 16);
    glBindFramebuffer(GL_FRAMEBUFFER, encoded);
    draw(frame, 40, 24);
    if (frame == 0) glReadPixels(0, 0, 40, 24, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    draw_window_and_swap(frame);
  }
  for (int y = 23; y >= 0; --y) fwrite(pixels + y * 160, 160, 1, stdout);
}

/* Two contexts that share nothing: their textures have the same name. The second turns away by
 * eglMakeCurrent. */
static void contexts(EGLConfig config, EGLint version) {
  EGLContext context[2] = {eglGetCurrentContext(), make_context(display, config, version)};
  GLuint framebuffer[2];
  for (int i = 0; i < 2; ++i) {
    eglMakeCurrent(display, window, window, context[i]);
    framebuffer[i] = make_framebuffer(make_texture(GL_RGBA8, 24 + 8 * i, 24));
  }
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame)
    for (int i = 0; i < 2; ++i) {
      eglMakeCurrent(display, window, window, context[i]);
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer[i]);
      draw(frame, 24 + 8 * i, 24);
    }
  draw_window_and_swap(0);
}

/* Headless: no surface, and glFinish, glFlush and glReadPixels end the frames. */
static void headless(const char* end) {
  unsigned char pixels[40 * 24 * 4];
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, eglGetCurrentContext());
  glFinish(); /* nothing is bound yet: no frame */
  make_framebuffer(make_texture(GL_RGBA8, 40, 24));
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    draw(frame, 40, 24);
    if (strcmp(end, "finish") == 0) glFinish();
    if (strcmp(end, "flush") == 0) glFlush();
    if (strcmp(end, "readpixels") == 0) glReadPixels(0, 0, 40, 24, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  }
  printf("error 0x%x, EGL error 0x%x\n", glGetError(), (unsigned)eglGetError());
}

/* A pbuffer that is never swapped. */
static void pbuffer(void) {
  for (unsigned frame = 0; frame < (unsigned)frames; ++frame) {
    draw(frame, kWidth, kHeight);
    glFinish();
  }
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const char* scene = argv[2];
  if (argc > 3) frames = atoi(argv[3]);
  const channel_bits bits = {8, 8, 8, 8, 0};
  es2 = strcmp(argv[1], "es2") == 0;
  const int desktop = strcmp(argv[1], "gl") == 0, glx = strcmp(argv[1], "glx") == 0;
  EGLConfig config = NULL;
  if (glx) {
    open_glx();
  } else {
    display = open_surfaceless();
    config = exact_config(display, bits);
    window = make_pbuffer(display, config, kWidth, kHeight);
    if (desktop) eglBindAPI(EGL_OPENGL_API);
    EGLContext context = desktop ? eglCreateContext(display, config, EGL_NO_CONTEXT, NULL)
                                 : make_context(display, config, es2 ? 2 : 3);
    if (!eglMakeCurrent(display, window, window, context)) return 9;
  }
  if (strcmp(scene, "single") == 0) single();
  if (strcmp(scene, "mrt") == 0) mrt();
  if (strcmp(scene, "pingpong") == 0) pingpong();
  if (strcmp(scene, "recreate") == 0) recreate();
  if (strcmp(scene, "resize") == 0) resize();
  if (strcmp(scene, "renderbuffers") == 0) renderbuffers();
  if (strcmp(scene, "multisampled") == 0) multisampled();
  if (strcmp(scene, "parts") == 0) parts();
  if (strcmp(scene, "invalidate") == 0) invalidate();
  if (strcmp(scene, "formats") == 0) formats();
  if (strcmp(scene, "contexts") == 0 && glx) glx_contexts();
  if (strcmp(scene, "contexts") == 0 && !glx) contexts(config, es2 ? 2 : 3);
  if (strcmp(scene, "finish") == 0 || strcmp(scene, "flush") == 0 || strcmp(scene, "readpixels") == 0)
    headless(scene);
  if (strcmp(scene, "pbuffer") == 0) pbuffer();
  fprintf(stderr, "error 0x%x\n", glGetError());
  return 0;
}
