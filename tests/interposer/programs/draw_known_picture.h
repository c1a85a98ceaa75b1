/* Draws the known picture into the current framebuffer with four GL functions. */
#pragma once

#include <GLES2/gl2.h>

#include "known_picture.h"

typedef struct {
  void (*ClearColor)(GLfloat, GLfloat, GLfloat, GLfloat);
  void (*Scissor)(GLint, GLint, GLsizei, GLsizei);
  void (*Enable)(GLenum);
  void (*Clear)(GLbitfield);
} draw_functions;

static inline void draw_known_picture(const draw_functions* gl, unsigned frame, int width, int height) {
  known_box box[KNOWN_BOXES];
  known_picture(frame, width, height, box);
  gl->Enable(GL_SCISSOR_TEST);
  for (int i = 0; i < KNOWN_BOXES; ++i) {
    const unsigned char* c = box[i].color;
    gl->ClearColor((float)c[0] / 255.0f, (float)c[1] / 255.0f, (float)c[2] / 255.0f, (float)c[3] / 255.0f);
    gl->Scissor(box[i].x, height - box[i].y - box[i].height, box[i].width, box[i].height);
    gl->Clear(GL_COLOR_BUFFER_BIT);
  }
}
