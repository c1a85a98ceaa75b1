/* osmesa_picture linked|opened FORMAT Y_UP END [FRAMES]: draws the known picture into memory with OSMesa.
 * FORMAT: rgba, bgra, argb, 565, rgb. END: what ends a frame: finish, flush, both (flush, then finish).
 * Prints a sum of the buffer and the GL error. */
#define _GNU_SOURCE
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_known_picture.h"

enum { kWidth = 33, kHeight = 21, kRowLength = 40 };

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const int opened = strcmp(argv[1], "opened") == 0;
  void* library = opened ? dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL) : NULL;
  if (opened && library == NULL) return 9;
#define GET(name) __typeof__(&name) p_##name = opened ? (__typeof__(&name))dlsym(library, #name) : &name
  GET(OSMesaCreateContextExt);
  GET(OSMesaMakeCurrent);
  GET(OSMesaPixelStore);
  GET(OSMesaGetProcAddress);
  GET(OSMesaDestroyContext);
#define GL(name) \
  __typeof__(&name) p_##name = opened ? (__typeof__(&name))(void*)p_OSMesaGetProcAddress(#name) : &name
  GL(glClearColor);
  GL(glScissor);
  GL(glEnable);
  GL(glClear);
  GL(glFinish);
  GL(glFlush);
  GL(glGetError);
  const draw_functions gl = {p_glClearColor, p_glScissor, p_glEnable, p_glClear};
  const int is565 = strcmp(argv[2], "565") == 0;
  const GLenum format = strcmp(argv[2], "rgba") == 0   ? OSMESA_RGBA
                        : strcmp(argv[2], "bgra") == 0 ? OSMESA_BGRA
                        : strcmp(argv[2], "argb") == 0 ? OSMESA_ARGB
                        : is565                        ? OSMESA_RGB_565
                                                       : OSMESA_RGB;
  const int frames = argc > 5 ? atoi(argv[5]) : 4;
  unsigned char* buffer = calloc(kRowLength * kHeight, 4);
  OSMesaContext context = p_OSMesaCreateContextExt(format, 16, 0, 0, NULL);
  if (!p_OSMesaMakeCurrent(context, buffer, is565 ? GL_UNSIGNED_SHORT_5_6_5 : GL_UNSIGNED_BYTE, kWidth,
                           kHeight))
    return 77;
  p_OSMesaPixelStore(OSMESA_Y_UP, atoi(argv[3]));
  p_OSMesaPixelStore(OSMESA_ROW_LENGTH, kRowLength);
  static const int kBits565[4] = {5, 6, 5, 0}, kBits8[4] = {8, 8, 8, 8};
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_levels(&gl, (unsigned)frame, kWidth, kHeight, is565 ? kBits565 : kBits8);
    if (strcmp(argv[4], "finish") != 0) p_glFlush();
    if (strcmp(argv[4], "flush") != 0) p_glFinish();
  }
  unsigned sum = 0;
  for (int i = 0; i < kRowLength * kHeight * 4; ++i) sum = sum * 31 + buffer[i];
  printf("buffer %08x error 0x%x\n", sum, p_glGetError());
  p_OSMesaDestroyContext(context);
  free(buffer);
  return 0;
}
