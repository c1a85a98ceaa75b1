/* Covering triangle: one whose edges cover a part of the samples of a pixel, and the frame as the program
 * reads it itself. */
#pragma once

#include <GLES3/gl3.h>
#include <stdio.h>
#include <stdlib.h>

static inline void draw_covering_triangle(unsigned frame) {
  static const char* const vertex = "attribute vec2 at; void main() { gl_Position = vec4(at, 0.0, 1.0); }";
  static const char* const fragment =
      "precision mediump float; void main() { gl_FragColor = vec4(0.9, 0.4, 0.1, 0.7); }";
  static GLuint program;
  if (program == 0) {
    program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
      const GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
      const char* const source[] = {"#version 100\n", i == 0 ? vertex : fragment};
      glShaderSource(shader, 2, source, NULL);
      glCompileShader(shader);
      glAttachShader(program, shader);
    }
    glBindAttribLocation(program, 0, "at");
    glLinkProgram(program);
  }
  const GLfloat corners[] = {-0.9f, -0.8f, 0.7f, -0.3f, 0.1f * (GLfloat)frame, 0.95f};
  glUseProgram(program);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, corners);
  glEnableVertexAttribArray(0);
  glClear(GL_COLOR_BUFFER_BIT);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* The current framebuffer on standard output, top row first. */
static inline void print_pixels(int width, int height) {
  const size_t row_bytes = (size_t)width * 4;
  unsigned char* pixels = malloc(row_bytes * (size_t)height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  for (int y = height - 1; y >= 0; --y) fwrite(pixels + (size_t)y * row_bytes, row_bytes, 1, stdout);
  free(pixels);
}

/* The same of a multisampled surface, as what its samples resolve to. */
static inline void print_resolved(int width, int height) {
  GLuint framebuffer, storage;
  glGenFramebuffers(1, &framebuffer);
  glGenRenderbuffers(1, &storage);
  glBindRenderbuffer(GL_RENDERBUFFER, storage);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, storage);
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  print_pixels(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteRenderbuffers(1, &storage);
}
