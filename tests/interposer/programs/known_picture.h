/* Known picture: what the sample programs draw, frame by frame, and what the tests expect to be captured.
   No symmetry: a flip, a swap of channels or of frames shows. Drawn with clears alone, so every GL can draw
   it. */
#pragma once

enum { KNOWN_BOXES = 6 };

/* A filled rectangle, origin at the top left. Later boxes cover earlier ones; box 0 covers everything. */
typedef struct {
  int x, y, width, height;
  unsigned char color[4]; /* R, G, B, A */
} known_box;

static inline void known_picture(unsigned frame, int width, int height, known_box box[KNOWN_BOXES]) {
  static const known_box kBoxes[KNOWN_BOXES] = {
      {0, 0, 0, 0, {12, 200, 77, 255}},  /* background */
      {0, 0, 5, 3, {255, 0, 1, 128}},    /* top left corner */
      {-4, 0, 4, 9, {3, 90, 255, 17}},   /* top right corner: x counts from the right edge */
      {7, -6, 11, 6, {250, 251, 2, 0}},  /* bottom edge */
      {16, 16, 1, 1, {1, 2, 3, 4}},      /* a single pixel */
      {9, 4, 13, 8, {128, 64, 32, 200}}, /* moves with the frame */
  };
  for (int i = 0; i < KNOWN_BOXES; ++i) {
    box[i] = kBoxes[i];
    if (box[i].x < 0) box[i].x += width;
    if (box[i].y < 0) box[i].y += height;
    for (int c = 0; c < 4; ++c)
      if (i != 1 && i != 4) box[i].color[c] = (unsigned char)(box[i].color[c] + frame * (unsigned)(3 + c));
  }
  box[0].width = width;
  box[0].height = height;
  box[5].x += (int)(frame * 3 % 16);
}
