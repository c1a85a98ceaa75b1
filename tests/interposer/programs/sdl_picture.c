/* sdl_picture FRAMES WIDTH HEIGHT: presents the known picture with SDL2, which finds GL by dlopen and dlsym.
 */
#include <SDL2/SDL.h>
#include <stdio.h>
#include <stdlib.h>

#include "draw_known_picture.h"

int main(int argc, char** argv) {
  if (argc < 4 || SDL_Init(SDL_INIT_VIDEO) != 0) return 9;
  const int frames = atoi(argv[1]), width = atoi(argv[2]), height = atoi(argv[3]);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 2);
  SDL_GL_SetAttribute(SDL_GL_ALPHA_SIZE, 8);
  SDL_Window* window = SDL_CreateWindow("known picture", 0, 0, width, height, SDL_WINDOW_OPENGL);
  if (window == NULL || SDL_GL_CreateContext(window) == NULL) return 9;
  const draw_functions gl = {
      (void (*)(GLfloat, GLfloat, GLfloat, GLfloat))SDL_GL_GetProcAddress("glClearColor"),
      (void (*)(GLint, GLint, GLsizei, GLsizei))SDL_GL_GetProcAddress("glScissor"),
      (void (*)(GLenum))SDL_GL_GetProcAddress("glEnable"),
      (void (*)(GLbitfield))SDL_GL_GetProcAddress("glClear")};
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_picture(&gl, (unsigned)frame, width, height);
    SDL_GL_SwapWindow(window);
  }
  SDL_Quit();
  return 0;
}
