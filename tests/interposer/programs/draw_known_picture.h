/* Draws the known picture into the current framebuffer with four GL functions. */
#pragma once

#ifndef EPOXY_GL_H /* which declares all of it, and minds a second */
#include <GLES2/gl2.h>
#endif

#include "known_picture.h"

typedef struct {
  void (*ClearColor)(GLfloat, GLfloat, GLfloat, GLfloat);
  void (*Scissor)(GLint, GLint, GLsizei, GLsizei);
  void (*Enable)(GLenum);
  void (*Clear)(GLbitfield);
} draw_functions;

/* In a framebuffer with `bits` bits per channel: value v of 0…255 is drawn as the level v · (2^bits − 1) /
   255, rounded down, so that the driver has nothing to round. */
static inline void draw_known_levels(const draw_functions* gl, unsigned frame, int width, int height,
                                     const int bits[4]) {
  known_box box[KNOWN_BOXES];
  known_picture(frame, width, height, box);
  gl->Enable(GL_SCISSOR_TEST);
  for (int i = 0; i < KNOWN_BOXES; ++i) {
    float value[4];
    for (int c = 0; c < 4; ++c) {
      const int largest = bits[c] > 0 ? (1 << bits[c]) - 1 : 1;
      value[c] = (float)(box[i].color[c] * largest / 255) / (float)largest;
    }
    gl->ClearColor(value[0], value[1], value[2], value[3]);
    gl->Scissor(box[i].x, height - box[i].y - box[i].height, box[i].width, box[i].height);
    gl->Clear(GL_COLOR_BUFFER_BIT);
  }
}

static inline void draw_known_picture(const draw_functions* gl, unsigned frame, int width, int height) {
  static const int kEightBits[4] = {8, 8, 8, 8};
  draw_known_levels(gl, frame, width, height, kEightBits);
}
