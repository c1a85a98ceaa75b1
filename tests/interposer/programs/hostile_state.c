/* hostile_state API [object|list]: for each read state of the engine's table that the context accepts,
   draws the known picture, gives the state a hostile value, presents, and checks that the state is still that
   and that no error is pending. At last all of them at once. Prints the state of each frame. API: glx, gl,
   core, es1, es2, es3 (EGL pbuffers), osmesa, osmesa-core. object: a framebuffer object that glFinish ends.
   list: two frames while a display list is compiled, the second with a state that no setter can change then.
   Exits with 3 if a state of the table has no hostile value here. */
#define GL_GLEXT_PROTOTYPES
#include "egl_session.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "interposer/engine/readback/read_states.h"

enum { kWidth = 33, kHeight = 21 };

static const struct {
  unsigned gl_name;
  double value;
} kHostile[] = {
    {0x0B33, 1},   {0x92E0, 1},    {0x8CAA, 1},   {0x0C02, GL_NONE}, {0x88ED, 1},   {0x0D05, 8},
    {0x0D00, 1},   {0x0D01, 1},    {0x0D02, 50},  {0x0D03, 3},       {0x0D04, 5},   {0x806B, 2},
    {0x806C, 30},  {0x912B, 4},    {0x912C, 4},   {0x912D, 2},       {0x912E, 16},  {0x8758, 1},
    {0x93A4, 1},   {0x8A15, 300},  {0x891C, 1},   {0x0D10, 1},       {0x0D11, 1},   {0x0D12, 3},
    {0x0D13, 7},   {0x0D14, 0.25}, {0x0D15, 0.5}, {0x0D18, 0.25},    {0x0D19, 0.5}, {0x0D1A, 0.25},
    {0x0D1B, 0.5}, {0x0D1C, 0.25}, {0x0D1D, 0.5}, {0x0D1E, 0.25},    {0x0D1F, 0.5}, {0x80D0, 1},
    {0x80D1, 1},   {0x80D2, 1},    {0x8010, 1},   {0x8011, 1},       {0x8012, 1},   {0x8024, 1},
    {0x802E, 1},   {0x80B1, 0.5},  {0x801C, 0.5}, {0x801D, 0.5},     {0x801E, 0.5}, {0x801F, 0.5},
    {0x8020, 0.5}, {0x8021, 0.5},  {0x8022, 0.5}, {0x8023, 0.5},     {0x80B4, 0.5}, {0x80B5, 0.5},
    {0x80B6, 0.5}, {0x80B7, 0.5},  {0x80B8, 0.5}, {0x80B9, 0.5},     {0x80BA, 0.5}, {0x80BB, 0.5},
};

static double hostile_value(unsigned gl_name, double neutral) {
  for (unsigned i = 0; i < sizeof kHostile / sizeof *kHostile; ++i)
    if (kHostile[i].gl_name == gl_name) return kHostile[i].value;
  return neutral;
}

static void* (*get_proc)(const char*);

/* The few functions that this program calls, of whichever library the API's lookup gives. */
#define GL_CALLS(X)                                                                                     \
  X(GetError)                                                                                           \
  X(GetIntegerv) X(GetFloatv) X(IsEnabled) X(Enable) X(Disable) X(PixelStorei) X(PixelTransferf)        \
      X(PixelMapfv) X(GetPixelMapfv) X(ReadBuffer) X(BindBuffer) X(GenBuffers) X(ClampColor) X(NewList) \
          X(EndList) X(CallList) X(Finish) X(ClearColor) X(Scissor) X(Clear) X(GenFramebuffers)         \
              X(BindFramebuffer) X(GenRenderbuffers) X(BindRenderbuffer) X(RenderbufferStorage)         \
                  X(FramebufferRenderbuffer) X(DebugMessageCallback) X(GetString) X(GenFramebuffersOES) \
                      X(BindFramebufferOES)
#define glGenFramebuffersOES glGenFramebuffers
#define glBindFramebufferOES glBindFramebuffer
#define DECLARE(name) __typeof__(&gl##name) name;
static struct { GL_CALLS(DECLARE) } gl;

static void load_gl(void) {
#define LOAD(name) gl.name = (__typeof__(gl.name))get_proc("gl" #name);
  GL_CALLS(LOAD)
}

static EGLDisplay display;
static EGLSurface surface;
static Display* x;
static Window window;
static int es1, finishes;

static void* get_by_glx(const char* name) {
  return (void*)glXGetProcAddressARB((const GLubyte*)name);
}
static void* get_by_egl(const char* name) {
  return (void*)eglGetProcAddress(name);
}

static void open_glx(void) {
  x = XOpenDisplay(NULL);
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, None};
  XVisualInfo* visual = x != NULL ? glXChooseVisual(x, DefaultScreen(x), wanted) : NULL;
  if (visual == NULL) exit(9);
  const Window root = DefaultRootWindow(x);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(x, root, visual->visual, AllocNone)};
  window = XCreateWindow(x, root, 0, 0, kWidth, kHeight, 0, visual->depth, InputOutput, visual->visual,
                         CWColormap | CWBorderPixel, &attributes);
  XMapWindow(x, window);
  XSync(x, False);
  if (!glXMakeCurrent(x, window, glXCreateContext(x, visual, NULL, True))) exit(9);
  get_proc = get_by_glx;
}

static void open_egl(const char* api) {
  const channel_bits bytes = {8, 8, 8, 8, 0};
  const EGLint core[] = {EGL_CONTEXT_MAJOR_VERSION,
                         3,
                         EGL_CONTEXT_MINOR_VERSION,
                         3,
                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                         1,
                         EGL_NONE};
  display = open_surfaceless();
  const EGLConfig config = exact_config(display, bytes);
  surface = make_pbuffer(display, config, kWidth, kHeight);
  const int embedded = strncmp(api, "es", 2) == 0;
  if (!embedded) eglBindAPI(EGL_OPENGL_API);
  const EGLContext context =
      embedded ? make_context(display, config, atoi(api + 2))
               : eglCreateContext(display, config, NULL, strcmp(api, "core") == 0 ? core : NULL);
  if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
  es1 = strcmp(api, "es1") == 0;
  get_proc = get_by_egl;
}

/* Numbers of GL/osmesa.h. */
static void open_osmesa(int core) {
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) exit(9);
  void* (*create)(const int*, void*) =
      (void* (*)(const int*, void*))dlsym(library, "OSMesaCreateContextAttribs");
  unsigned char (*make_current)(void*, void*, unsigned, int, int) =
      (unsigned char (*)(void*, void*, unsigned, int, int))dlsym(library, "OSMesaMakeCurrent");
  const int profile[] = {0x33, core ? 0x34 : 0x35, 0x36, core ? 3 : 2, 0x37, core ? 3 : 1, 0};
  void* context = create(profile, NULL);
  if (!make_current(context, calloc(kWidth * kHeight, 4), GL_UNSIGNED_BYTE, kWidth, kHeight)) exit(9);
  get_proc = (void* (*)(const char*))dlsym(library, "OSMesaGetProcAddress");
  finishes = 1;
}

static int presenting;

static void present(void) {
  presenting = 1;
  if (finishes)
    gl.Finish();
  else if (x != NULL)
    glXSwapBuffers(x, window);
  else if (!eglSwapBuffers(display, surface))
    exit(8);
  presenting = 0;
}

static unsigned asked_name(const read_state* state) {
  GLint value = 0;
  if (state->kind != kReadFramebuffer) return state->gl_name;
  gl.GetIntegerv(state->gl_name, &value);
  return gl.GetError() == GL_NO_ERROR ? state->gl_name : 0x8CA6; /* GL_FRAMEBUFFER_BINDING */
}

static double ask(const read_state* state) {
  GLint value = 0;
  GLfloat real[16] = {0};
  switch (state->kind) {
    case kReadCapability:
      return gl.IsEnabled(state->gl_name);
    case kReadTransferReal:
    case kReadColorMatrix:
      gl.GetFloatv(state->gl_name, real);
      return real[0];
    default:
      gl.GetIntegerv(asked_name(state), &value);
      return value;
  }
}

static GLuint framebuffer, pack_buffer;

static void set(const read_state* state, double value) {
  static const GLfloat kDark[2] = {1, 0};
  switch (state->kind) {
    case kReadDisplayList:
      if (value != 0)
        gl.NewList((GLuint)value, GL_COMPILE);
      else
        gl.EndList();
      break;
    case kReadCapability:
      (value != 0 ? gl.Enable : gl.Disable)(state->gl_name);
      break;
    case kReadPack:
      gl.PixelStorei(state->gl_name, (GLint)value);
      break;
    case kReadTransfer:
    case kReadTransferReal:
      for (GLenum map = GL_PIXEL_MAP_R_TO_R; state->gl_name == GL_MAP_COLOR && map <= GL_PIXEL_MAP_A_TO_A;
           ++map)
        gl.PixelMapfv(map, 2, kDark);
      gl.PixelTransferf(state->gl_name, (GLfloat)value);
      break;
    case kReadColorMatrix:
      break;
    case kReadClamp:
      gl.ClampColor(state->gl_name, (GLenum)value);
      break;
    case kReadPackBuffer:
      gl.BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)value);
      break;
    case kReadFramebuffer:
      (es1 ? gl.BindFramebufferOES : gl.BindFramebuffer)(
          asked_name(state) == state->gl_name ? GL_READ_FRAMEBUFFER : GL_FRAMEBUFFER, (GLuint)value);
      break;
    case kReadBuffer:
      gl.ReadBuffer((GLenum)value);
      break;
  }
}

/* A name in the table stands for an object of this program. */
static double value_to_set(const read_state* state, double before) {
  if (state->kind == kReadFramebuffer) return before == 0 ? framebuffer : 0;
  if (state->kind == kReadPackBuffer) return pack_buffer;
  return hostile_value(state->gl_name, state->neutral);
}

static void check(const read_state* state, double expected) {
  const double found = ask(state);
  if (found != expected) printf("%s is %g, not %g\n", state->name, found, expected);
}

static void check_map(const read_state* state) {
  GLfloat map[2] = {0};
  if (state->gl_name != GL_MAP_COLOR) return;
  gl.GetPixelMapfv(GL_PIXEL_MAP_G_TO_G, map);
  if (map[0] != 1 || map[1] != 0) printf("the map of green is %g %g\n", (double)map[0], (double)map[1]);
}

static void check_error(const char* when) {
  const GLenum error = gl.GetError();
  if (error != GL_NO_ERROR) printf("%s: error 0x%x\n", when, error);
}

static void APIENTRY debug_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                   const GLchar* message, const void* user) {
  (void)source, (void)type, (void)id, (void)severity, (void)length, (void)user;
  if (presenting) printf("debug message: %s\n", message);
}

static void draw(unsigned frame) {
  const draw_functions functions = {gl.ClearColor, gl.Scissor, gl.Enable, gl.Clear};
  draw_known_picture(&functions, frame, kWidth, kHeight);
}

/* With the picture of frame `frame`, one state after the other and then all. */
static void present_states(void) {
  double before[kReadStateCount], hostile[kReadStateCount];
  int known[kReadStateCount];
  unsigned frame = 0;
  for (int i = 0; i < kReadStateCount; ++i) {
    const read_state* state = &kReadStates[i];
    before[i] = ask(state);
    const int single_binding =
        state->kind == kReadFramebuffer && finishes && asked_name(state) != state->gl_name;
    known[i] = gl.GetError() == GL_NO_ERROR && !single_binding;
    if (!known[i]) continue;
    hostile[i] = value_to_set(state, before[i]);
    draw(frame);
    set(state, hostile[i]);
    known[i] = gl.GetError() == GL_NO_ERROR; /* Mesa answers for states that the version lacks */
    if (!known[i]) continue;
    present();
    check_error(state->name);
    check(state, hostile[i]);
    check_map(state);
    set(state, before[i]);
    check_error(state->name);
    printf("frame %u %s\n", frame++, state->name);
  }
  draw(frame);
  for (int i = kReadStateCount - 1; i > 0; --i) /* a read buffer belongs to the framebuffer that is bound */
    if (known[i]) set(&kReadStates[i], hostile[i]);
  check_error("all");
  present();
  check_error("all");
  for (int i = 1; i < kReadStateCount; ++i)
    if (known[i] && kReadStates[i].kind != kReadBuffer) check(&kReadStates[i], hostile[i]);
  printf("frame %u all\n", frame);
}

static void present_in_lists(void) {
  GLfloat scale = 0;
  for (unsigned frame = 0; frame < 2; ++frame) {
    draw(frame);
    if (frame == 1) gl.PixelTransferf(GL_RED_SCALE, 0.25f);
    gl.NewList(1, GL_COMPILE);
    present();
    gl.EndList();
    gl.PixelTransferf(GL_RED_SCALE, 0.75f);
    gl.CallList(1);
    gl.GetFloatv(GL_RED_SCALE, &scale);
    printf("red scale after the list: %g\n", (double)scale);
    gl.PixelTransferf(GL_RED_SCALE, 1);
  }
  check_error("list");
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const char *api = argv[1], *scene = argc > 2 ? argv[2] : "";
  for (int i = 0; i < kReadStateCount; ++i)
    if (hostile_value(kReadStates[i].gl_name, kReadStates[i].neutral) == kReadStates[i].neutral &&
        kReadStates[i].kind != kReadBuffer) {
      printf("no hostile value for %s\n", kReadStates[i].name);
      return 3;
    }
  if (strcmp(api, "glx") == 0)
    open_glx();
  else if (strncmp(api, "osmesa", 6) == 0)
    open_osmesa(strcmp(api, "osmesa-core") == 0);
  else
    open_egl(api);
  load_gl();
  printf("%s\n", (const char*)gl.GetString(GL_VERSION));
  if (strcmp(scene, "list") == 0) {
    present_in_lists();
    return 0;
  }
  (es1 ? gl.GenFramebuffersOES : gl.GenFramebuffers)(1, &framebuffer);
  if (!es1) gl.GenBuffers(1, &pack_buffer);
  if (gl.DebugMessageCallback != NULL && !es1) gl.DebugMessageCallback(debug_message, NULL);
  if (strcmp(scene, "object") == 0) {
    GLuint storage, object;
    gl.GenFramebuffers(1, &object);
    gl.GenRenderbuffers(1, &storage);
    gl.BindRenderbuffer(GL_RENDERBUFFER, storage);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kWidth, kHeight);
    gl.BindFramebuffer(GL_FRAMEBUFFER, object);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, storage);
    finishes = 1;
  }
  while (gl.GetError() != GL_NO_ERROR) {
  }
  present_states();
  return 0;
}
