/* EGL session: a display without a window system and pbuffers of a chosen format on it, for the sample
 * programs. */
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <stdlib.h>

#include "draw_known_picture.h"

typedef struct {
  int red, green, blue, alpha, floating;
} channel_bits;

/* Mesa's platform, or the first device of a driver that has only those. */
static inline EGLDisplay open_surfaceless(void) {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  if (eglInitialize(display, NULL, NULL)) return display;
  PFNEGLQUERYDEVICESEXTPROC query_devices =
      (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
  EGLDeviceEXT device;
  EGLint count = 0;
  if (!query_devices || !query_devices(1, &device, &count) || count == 0) exit(9);
  display = eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, NULL);
  if (!eglInitialize(display, NULL, NULL)) exit(9);
  return display;
}

/* The first config with exactly these channels and samples per pixel; the program ends with 77 if there is
 * none. */
static inline EGLConfig sampled_config(EGLDisplay display, channel_bits bits, EGLint wanted_samples) {
  EGLConfig configs[256];
  EGLint count = 0, red, green, blue, alpha, samples, type;
  eglGetConfigs(display, configs, 256, &count);
  for (EGLint i = 0; i < count; ++i) {
    eglGetConfigAttrib(display, configs[i], EGL_RED_SIZE, &red);
    eglGetConfigAttrib(display, configs[i], EGL_GREEN_SIZE, &green);
    eglGetConfigAttrib(display, configs[i], EGL_BLUE_SIZE, &blue);
    eglGetConfigAttrib(display, configs[i], EGL_ALPHA_SIZE, &alpha);
    eglGetConfigAttrib(display, configs[i], EGL_SAMPLES, &samples);
    eglGetConfigAttrib(display, configs[i], EGL_COLOR_COMPONENT_TYPE_EXT, &type);
    if (red == bits.red && green == bits.green && blue == bits.blue && alpha == bits.alpha &&
        samples == wanted_samples && (type == EGL_COLOR_COMPONENT_TYPE_FLOAT_EXT) == bits.floating)
      return configs[i];
  }
  exit(77);
}

static inline EGLConfig exact_config(EGLDisplay display, channel_bits bits) {
  return sampled_config(display, bits, 0);
}

static inline EGLSurface make_pbuffer(EGLDisplay display, EGLConfig config, int width, int height) {
  const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
  return eglCreatePbufferSurface(display, config, size);
}

static inline EGLContext make_context(EGLDisplay display, EGLConfig config, EGLint version) {
  const EGLint wish[] = {EGL_CONTEXT_CLIENT_VERSION, version, EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, wish);
}

static const draw_functions kLinkedGl = {glClearColor, glScissor, glEnable, glClear};
