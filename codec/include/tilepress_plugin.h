/* Plugin interface: a compression scheme as a C table of functions, in a shared library of its own.
 *
 * A plugin defines tilepress_scheme(), declared at the end of this file. `tilepress ... --plugin lib.so` loads
 * it. C11 and C++20.
 *
 * Rules for every function of a scheme:
 * - The results depend on the setup, the frame and the block alone. State must not travel from frame to frame:
 *   frames come in any order and on several threads. Equal blocks of a frame have equal bits, unless the
 *   scheme sets TP_NEEDS_PLACE.
 * - One state is used by one thread at a time, and may move between threads. Different states are used at the
 *   same time. tilepress_scheme() runs once, before all others.
 * - A function may allocate memory. It opens no file, starts no thread, changes no signal handler, and lets no
 *   exception and no longjmp() out. In a captured program it runs beside the program's threads.
 */
#ifndef TILEPRESS_PLUGIN_H
#define TILEPRESS_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the interface. A table of another version is refused. Structures grow only at their ends, and
 * each begins with its size, so that either side sees which members the other one knows. */
#define TP_PLUGIN_ABI 1u

#define TP_BLOCK_PIXELS 64u     /* 8 x 8 */
#define TP_PAYLOAD_BYTES 256u   /* room for the payload of a block: 64 pixels of 32 bits */
#define TP_CSB_BYTES 16u        /* room for the compression status bits of a block */
#define TP_NO_COLOR 0xFFFFu     /* index of a pixel whose colour the palette lacks */
#define TP_BAD_BLOCK UINT32_MAX /* result of decode() for bits that encode() never writes */

/* Pixel formats. A pixel word holds the pixel's bytes in memory, little-endian:
 * R | G << 8 | B << 16 | A << 24;  the same with A = 255;  B | G << 5 | R << 11;  R | G << 10 | B << 20 | A << 30 */
enum { TP_RGBA8 = 0, TP_RGBX8 = 1, TP_RGB565 = 2, TP_RGB10A2 = 3 };

/* What values a key takes. */
enum { TP_KEY_NUMBER = 0, TP_KEY_POWER_OF_TWO = 1, TP_KEY_CHOICE = 2 };

/* A key of the scheme: `-s name:key=value`. */
typedef struct tp_scheme_key {
  const char *name;
  const char *summary;
  uint32_t kind;
  uint32_t low, high;  /* range of a number */
  uint32_t initial;    /* default: a number, or the position of a choice */
  const char *choices; /* of TP_KEY_CHOICE: "fast, small"; else NULL */
} tp_scheme_key;

/* What a state is made for. */
typedef struct tp_scheme_setup {
  uint32_t struct_bytes;
  uint32_t format;
  uint32_t pixel_bits;       /* 32 or 16 */
  uint8_t channel_bits[4];   /* R, G, B, A; 0 = absent */
  uint8_t channel_shift[4];  /* lowest bit of the channel in a pixel word */
  uint32_t tile_side;        /* render tile, pixels */
  uint32_t burst_bits;       /* DRAM transfer unit */
  uint32_t decodes;          /* 0: the state encodes; 1: it decodes */
  const uint32_t *values;    /* one per key, in the order of the table: a number, or the position of a choice */
} tp_scheme_setup;

enum {
  TP_NEEDS_PLACE = 1,       /* bits depend on the block's place */
  TP_NEEDS_WHOLE_FRAME = 2, /* begin_frame() reads the frame's pixels */
  TP_NEEDS_FIRST_FRAME = 4  /* the surface's first frame, passed to begin_frame(), affects all later frames */
};

typedef struct tp_scheme_needs {
  uint32_t struct_bytes;
  uint32_t flags;         /* TP_NEEDS_* */
  uint32_t palette_slots; /* entries of the palette: 0 = none, or a power of two from 2 to 1024 */
} tp_scheme_needs;

/* A frame to encode. */
typedef struct tp_scheme_frame {
  uint32_t struct_bytes;
  uint32_t width, height;     /* pixels */
  uint32_t blocks_x, blocks_y;
  uint64_t ordinal;           /* 0 = the surface's first frame */
  const uint32_t *palette;    /* most frequent colours of the frame before, the most frequent first */
  uint32_t palette_colors;    /* their number; 0 in the first frame */
  const uint32_t *pixels;     /* with TP_NEEDS_WHOLE_FRAME: rows padded to whole blocks; else NULL */
  uint32_t stride;            /* words from row to row */
} tp_scheme_frame;

/* A block to encode. Pixels outside the surface repeat the nearest one inside. */
typedef struct tp_scheme_block {
  uint32_t struct_bytes;
  uint32_t bx, by;         /* column and row of blocks; valid with TP_NEEDS_PLACE */
  uint32_t uniform;        /* 1: all pixels are equal */
  const uint32_t *pixels;  /* 64 words: pixel (x, y) is pixels[8 * y + x] */
  const uint16_t *indices; /* with a palette: index of each pixel's colour, or TP_NO_COLOR; else NULL */
} tp_scheme_block;

enum {
  TP_SCHEME_EIGHT_BIT_ONLY = 1, /* RGBA8 and RGBX8 surfaces only */
  TP_SCHEME_FRAME_BEFORE = 2    /* a frame's bits alone do not restore the frame */
};

/* A scheme. Functions marked "may be NULL" have the default in brackets. Everything that the table points to
 * lives until the process ends. */
typedef struct tp_scheme {
  uint32_t abi;          /* TP_PLUGIN_ABI */
  uint32_t struct_bytes; /* sizeof(tp_scheme) */

  const char *name;    /* letters, digits, '_' and '-'; what -s takes */
  const char *label;   /* for reports; may be NULL [name] */
  const char *summary; /* one sentence */
  const char *source;  /* a publication; may be NULL ["a plugin"] */
  uint32_t flags;      /* TP_SCHEME_* */
  uint32_t key_count;
  const tp_scheme_key *keys;
  uint32_t column_count; /* columns of schemes.csv that account() counts, at most 4 */
  const char *const *columns;

  /* Makes a state, or returns NULL. destroy() may be NULL [nothing]. */
  void *(*create)(const tp_scheme_setup *setup);
  void (*destroy)(void *state);

  /* Encoding. Called once per state: */
  void (*needs)(const void *state, tp_scheme_needs *needs); /* may be NULL [none] */
  /* Once per frame. The frame's memory is valid during the call. */
  void (*begin_frame)(void *state, const tp_scheme_frame *frame); /* may be NULL [nothing] */
  /* Compression status bits of each block of the frame, at most 128. */
  uint32_t (*csb_bits)(const void *state);
  /* Bits of the tables that go with the frame, and the tables. `bytes` is zero. May both be NULL [none]. */
  uint64_t (*table_bits)(const void *state);
  void (*write_tables)(const void *state, uint8_t *bytes);
  /* Payload bits that encode() writes. May be NULL [encode() and drop the bits]. */
  uint32_t (*measure)(const void *state, const tp_scheme_block *block);
  /* Writes payload and status bits, the highest bit of a byte first, and returns the number of payload bits:
   * at most 64 * pixel_bits. `payload` has TP_PAYLOAD_BYTES and `csb` TP_CSB_BYTES zero bytes. */
  uint32_t (*encode)(const void *state, const tp_scheme_block *block, uint8_t *payload, uint8_t *csb);
  /* Adds the block to the columns. May be NULL [columns are zero]. */
  void (*account)(const void *state, const tp_scheme_block *block, uint32_t payload_bits, uint64_t *counts);

  /* Decoding, on a state of its own. Returns 0 for tables that write_tables() never writes. May be NULL [no tables]. */
  int (*begin_decoding)(void *state, const uint8_t *tables, uint64_t table_bits, uint32_t csb_bits);
  /* Restores the 64 pixels of a block, and returns the payload bits it used or TP_BAD_BLOCK. `payload` has
   * TP_PAYLOAD_BYTES and `csb` TP_CSB_BYTES bytes; zeros follow the block's bits. Any bits may come. */
  uint32_t (*decode)(void *state, uint32_t bx, uint32_t by, const uint8_t *csb, const uint8_t *payload,
                     uint32_t *pixels);
} tp_scheme;

/* For plugins: appends the low `count` bits of `value`, highest first, at bit *at of zero bytes. count <= 32. */
static inline void tp_put_bits(uint8_t *bytes, uint32_t *at, uint32_t value, uint32_t count) {
  for (; count > 0; --count, ++*at)
    if ((value >> (count - 1) & 1u) != 0) bytes[*at / 8] = (uint8_t)(bytes[*at / 8] | 0x80u >> *at % 8);
}

/* For plugins: returns `count` bits from bit *at on, and moves *at behind them. count <= 32. */
static inline uint32_t tp_get_bits(const uint8_t *bytes, uint32_t *at, uint32_t count) {
  uint32_t value = 0;
  for (; count > 0; --count, ++*at) value = value << 1 | (bytes[*at / 8] >> (7 - *at % 8) & 1u);
  return value;
}

#if defined(__GNUC__)
#define TP_PLUGIN_EXPORT __attribute__((visibility("default")))
#else
#define TP_PLUGIN_EXPORT
#endif

/* The function that a plugin exports: returns scheme number `index` of the plugin, or NULL behind the last. */
TP_PLUGIN_EXPORT const tp_scheme *tilepress_scheme(uint32_t index);

#ifdef __cplusplus
}
#endif

#endif /* TILEPRESS_PLUGIN_H */
