/* Hostile plugins: the example, with one fault each. The macro FAULT chooses the fault. */
enum { kVersion, kNoDecode, kNameTaken, kMeasure, kPixels, kTooLong, kNoScheme, kUndefined };

#define tilepress_scheme good_scheme
#include "rowpal_plugin.c"
#undef tilepress_scheme

extern void no_such_function(void);

static uint32_t one_bit_less(const void *state, const tp_scheme_block *block) { return measure(state, block) - 1; }

static uint32_t other_pixels(void *state, uint32_t bx, uint32_t by, const uint8_t *csb, const uint8_t *payload,
                             uint32_t *pixels) {
  const uint32_t used = decode(state, bx, by, csb, payload, pixels);
  pixels[63] ^= 1;
  return used;
}

/* Longer than a block, but only where the first pixel is 1, any, 255, 255. */
static uint32_t too_long(const void *state, const tp_scheme_block *block, uint8_t *payload, uint8_t *csb) {
  const uint32_t bits = encode(state, block, payload, csb);
  return (block->pixels[0] & 0xFFFF00FFu) == 0xFFFF0001u ? 5000 : bits;
}

TP_PLUGIN_EXPORT const tp_scheme *tilepress_scheme(uint32_t index);
const tp_scheme *tilepress_scheme(uint32_t index) {
  static tp_scheme bad;
  if (index > 0 || FAULT == kNoScheme) return NULL;
  bad = *good_scheme(0);
  if (FAULT == kVersion) bad.abi = 99;
  if (FAULT == kNoDecode) bad.decode = NULL;
  if (FAULT == kNameTaken) bad.name = "vdcp";
  if (FAULT == kMeasure) bad.measure = one_bit_less;
  if (FAULT == kPixels) bad.decode = other_pixels;
  if (FAULT == kTooLong) bad.encode = too_long, bad.measure = NULL;
#if FAULT == 7 /* kUndefined: a preprocessor knows no enumerators */
  no_such_function();
#endif
  return &bad;
}
