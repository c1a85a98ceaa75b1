/* glfw_picture egl|glx|osmesa FRAMES WIDTH HEIGHT: presents the known picture in a GLFW window with the
 * context asked for. */
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_known_picture.h"

int main(int argc, char** argv) {
  if (argc < 5 || !glfwInit()) return 9;
  const int frames = atoi(argv[2]), width = atoi(argv[3]), height = atoi(argv[4]);
  if (strcmp(argv[1], "egl") == 0) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  }
  if (strcmp(argv[1], "osmesa") == 0) glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_OSMESA_CONTEXT_API);
  glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);
  GLFWwindow* window = glfwCreateWindow(width, height, "known picture", NULL, NULL);
  if (window == NULL) return 9;
  glfwMakeContextCurrent(window);
  const draw_functions gl = {(void (*)(GLfloat, GLfloat, GLfloat, GLfloat))glfwGetProcAddress("glClearColor"),
                             (void (*)(GLint, GLint, GLsizei, GLsizei))glfwGetProcAddress("glScissor"),
                             (void (*)(GLenum))glfwGetProcAddress("glEnable"),
                             (void (*)(GLbitfield))glfwGetProcAddress("glClear")};
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_picture(&gl, (unsigned)frame, width, height);
    glfwSwapBuffers(window);
    glfwPollEvents();
  }
  glfwTerminate();
  printf("done\n");
  return 0;
}
