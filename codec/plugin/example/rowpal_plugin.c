/* rowpal: an example of a scheme in a plugin. A row of a block is written as indices if the palette has its colours.
 *   CSB      8 x 1 bit: 1 = indices
 *   payload  per row: 8 indices of log2(slots) bits, or 8 pixels
 *   tables   the colours of the palette */
#include <stdlib.h>
#include <string.h>
#include <tilepress_plugin.h>

typedef struct {
  uint32_t pixel_bits, slots, width; /* width: bits of an index */
  uint32_t count, colors[256];       /* the palette of the frame */
} rowpal;

static void *create(const tp_scheme_setup *setup) {
  rowpal *own = calloc(1, sizeof *own);
  if (own == NULL) return NULL;
  own->pixel_bits = setup->pixel_bits;
  own->slots = setup->values[0];
  while (1u << own->width < own->slots) ++own->width;
  return own;
}
static void needs(const void *state, tp_scheme_needs *out) { out->palette_slots = ((const rowpal *)state)->slots; }
static void begin_frame(void *state, const tp_scheme_frame *frame) {
  rowpal *own = state;
  own->count = frame->palette_colors;
  if (own->count > 0) memcpy(own->colors, frame->palette, own->count * sizeof own->colors[0]);
}
static uint32_t csb_bits(const void *state) { return (void)state, 8; }
static uint64_t table_bits(const void *state) {
  return (uint64_t)((const rowpal *)state)->count * ((const rowpal *)state)->pixel_bits;
}
static void write_tables(const void *state, uint8_t *bytes) {
  const rowpal *own = state;
  uint32_t at = 0;
  for (uint32_t i = 0; i < own->count; ++i) tp_put_bits(bytes, &at, own->colors[i], own->pixel_bits);
}
static int is_known(const tp_scheme_block *block, uint32_t row) {
  for (uint32_t i = 8 * row; i < 8 * row + 8; ++i)
    if (block->indices[i] == TP_NO_COLOR) return 0;
  return 1;
}
static uint32_t known_rows(const tp_scheme_block *block) {
  uint32_t rows = 0;
  for (uint32_t row = 0; row < 8; ++row) rows += is_known(block, row) ? 1 : 0;
  return rows;
}
static uint32_t measure(const void *state, const tp_scheme_block *block) {
  const rowpal *own = state;
  const uint32_t known = known_rows(block);
  return 8 * (known * own->width + (8 - known) * own->pixel_bits);
}
static uint32_t encode(const void *state, const tp_scheme_block *block, uint8_t *payload, uint8_t *csb) {
  const rowpal *own = state;
  uint32_t at = 0, mark = 0;
  for (uint32_t row = 0; row < 8; ++row) {
    const int known = is_known(block, row);
    tp_put_bits(csb, &mark, known ? 1 : 0, 1);
    for (uint32_t i = 8 * row; i < 8 * row + 8; ++i)
      known ? tp_put_bits(payload, &at, block->indices[i], own->width)
            : tp_put_bits(payload, &at, block->pixels[i], own->pixel_bits);
  }
  return at;
}
static void account(const void *state, const tp_scheme_block *block, uint32_t bits, uint64_t *counts) {
  (void)state, (void)bits, counts[0] += known_rows(block);
}
static int begin_decoding(void *state, const uint8_t *tables, uint64_t bits, uint32_t marks) {
  rowpal *own = state;
  uint32_t at = 0;
  if (marks != 8 || bits % own->pixel_bits != 0 || bits / own->pixel_bits > own->slots) return 0;
  own->count = (uint32_t)(bits / own->pixel_bits);
  for (uint32_t i = 0; i < own->count; ++i) own->colors[i] = tp_get_bits(tables, &at, own->pixel_bits);
  return 1;
}
static uint32_t decode(void *state, uint32_t bx, uint32_t by, const uint8_t *csb, const uint8_t *payload,
                       uint32_t *pixels) {
  const rowpal *own = state;
  uint32_t at = 0, mark = 0;
  (void)bx, (void)by;
  for (uint32_t row = 0; row < 8; ++row) {
    const uint32_t known = tp_get_bits(csb, &mark, 1);
    for (uint32_t i = 8 * row; i < 8 * row + 8; ++i) {
      pixels[i] = tp_get_bits(payload, &at, known ? own->width : own->pixel_bits);
      if (known && pixels[i] >= own->count) return TP_BAD_BLOCK;
      if (known) pixels[i] = own->colors[pixels[i]];
    }
  }
  return at;
}

static const tp_scheme_key keys[] = {{"slots", "colours of the palette", TP_KEY_POWER_OF_TWO, 2, 256, 16, NULL}};
static const char *const columns[] = {"rowpal_rows"};
static const tp_scheme scheme = {
    .abi = TP_PLUGIN_ABI, .struct_bytes = sizeof scheme, .name = "rowpal", .label = "Row palette",
    .summary = "rows of a block as palette indices", .key_count = 1, .keys = keys, .column_count = 1, .columns = columns,
    .create = create, .destroy = free, .needs = needs, .begin_frame = begin_frame, .csb_bits = csb_bits,
    .table_bits = table_bits, .write_tables = write_tables, .measure = measure, .encode = encode,
    .account = account, .begin_decoding = begin_decoding, .decode = decode};
const tp_scheme *tilepress_scheme(uint32_t index) { return index == 0 ? &scheme : NULL; }
