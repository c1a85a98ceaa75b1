/* tilepress in C: compresses frames with the schemes of tilepress, and returns bits and statistics.
 *
 *   tp_engine *engine = tp_engine_open(1280, 720, TP_RGBA8, "vdcp ras", NULL);
 *   tp_engine_push(engine, pixels, 1280 * 4);
 *   tp_statistics figures = {sizeof figures};
 *   tp_engine_statistics(engine, 0, &figures);
 *   tp_engine_close(engine);
 *
 * Link with -ltilepress (pkg-config tilepress, CMake target tilepress::c). C11 and C++20.
 *
 * Errors: a function that fails returns a status other than TP_OK, or NULL. tp_error() returns the reason.
 * A failed call changes nothing that the caller can see, but its structures may be filled in part.
 *
 * Threads: one object (engine, decoder) belongs to one thread at a time. Objects are independent of each
 * other. tp_error() is about the calling thread. tp_register_scheme() must come before all objects.
 *
 * Versions: within a soname functions and members are only added. Structures grow at their ends. Set
 * struct_bytes to the size of the structure: the library reads and writes that many bytes at most, and refuses
 * options that it does not know unless they are 0.
 */
#ifndef TILEPRESS_H
#define TILEPRESS_H

#include <stddef.h>
#include <stdint.h>

#include "tilepress_plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TP_VERSION_MAJOR 0
#define TP_VERSION_MINOR 2
#define TP_VERSION_PATCH 0

#if defined(__GNUC__)
#define TP_API __attribute__((visibility("default")))
#else
#define TP_API
#endif

/* TP_RGBA8 and TP_RGBX8 with the bytes of a pixel in the order B, G, R, A. */
enum { TP_BGRA8 = 0x100, TP_BGRX8 = 0x101 };

typedef int32_t tp_status;
enum {
  TP_OK = 0,
  TP_BAD_ARGUMENT = 1, /* NULL, a size, format, option or number out of range */
  TP_BAD_SCHEME = 2,   /* an unknown scheme or key, or a bad value */
  TP_UNSUPPORTED = 3,  /* the scheme does not support the surface's format */
  TP_NO_FRAME = 4,     /* no frame has been pushed, or its blocks were not kept */
  TP_NO_SPACE = 5,     /* the caller's memory is too small */
  TP_BAD_BITS = 6,     /* bits that no encoder writes */
  TP_NO_MEMORY = 7,
  TP_FAILED = 8        /* a plugin broke its contract, or an internal error */
};

/* The version of the loaded library: 10000 * major + 100 * minor + patch. */
TP_API uint32_t tp_version(void);
/* The reason of the calling thread's last failed call, in one line; "" before. Valid until its next one. */
TP_API const char *tp_error(void);
/* The status of the calling thread's last failed call. */
TP_API tp_status tp_error_status(void);
/* The name of scheme number `index`, or NULL behind the last. */
TP_API const char *tp_scheme_name(uint32_t index);
/* Adds a scheme. `scheme` must live until the process ends. Call it before anything else. */
TP_API tp_status tp_register_scheme(const tp_scheme *scheme);

/* What an engine models. 0 stands for the default of a number. */
typedef struct tp_options {
  uint32_t struct_bytes;
  uint32_t tile_side;   /* render tile, pixels: a multiple of 8 up to 4096; default 32 */
  uint32_t burst_bits;  /* DRAM transfer unit: a power of two from 16 to 2048; default 128 */
  uint32_t toggle_bits; /* 16 or 32: count the toggles of a bus of so many bits; default off */
  uint32_t verify;      /* 1: encode, decode and compare every block */
  uint32_t keep_blocks; /* 1: keep the bits of each frame for tp_engine_encode_block() and tp_engine_tables() */
  uint32_t no_metrics;  /* 1: leave out the figures of the frame itself, which saves time */
} tp_options;

/* Figures of one scheme, of a frame or summed over frames. Sizes are in bits. */
typedef struct tp_statistics {
  uint32_t struct_bytes;
  uint32_t skipped;       /* 1: the scheme does not support the format; all else is 0 */
  uint64_t blocks;
  uint64_t raw_bits;
  uint64_t payload_bits;
  uint64_t bursts;
  uint64_t burst_bits;    /* of one burst */
  uint64_t csb_bits;      /* compression status bits of all blocks */
  uint64_t table_bits;    /* palette or code table */
  uint64_t extra_bits;    /* further traffic: a second pass, checksums */
  uint64_t checked_blocks, mismatched_blocks; /* with verify */
  uint64_t own[4];        /* the scheme's own columns */
  uint64_t toggles, toggles_dbi, raw_toggles, raw_toggles_dbi; /* with toggle_bits */
  double rate;            /* raw / (bursts * burst_bits + CSB + tables) */
  double rate_payload;    /* raw / (payload + CSB) */
  double rate_with_extra;
} tp_statistics;

/* The last frame and its own figures. */
typedef struct tp_frame {
  uint32_t struct_bytes;
  uint32_t width, height;
  uint32_t blocks_x, blocks_y;
  uint32_t raw_block_bits; /* of a block without compression */
  uint64_t number;         /* 0 = the first frame */
  uint64_t unique_colors;
  double entropy;          /* bits per pixel */
  double pixel_change, color_change; /* 0 to 1, against the frame before */
  double fvc_coverage, fvc_relative_coverage, top100_coverage; /* 0 to 1 */
} tp_frame;

/* Compresses the frames of one surface. */
typedef struct tp_engine tp_engine;

/* `schemes`: specifications with spaces between, as "vdcp hdcp:fvc=128 ras:ycocg={0,1}".
 * `options`: NULL for the defaults. Sides are 1 to 65535 pixels. Returns NULL on failure. */
TP_API tp_engine *tp_engine_open(uint32_t width, uint32_t height, uint32_t format, const char *schemes,
                                 const tp_options *options);
TP_API void tp_engine_close(tp_engine *engine); /* NULL is allowed */

/* The number of schemes; the specification of one, or NULL. */
TP_API uint32_t tp_engine_scheme_count(const tp_engine *engine);
TP_API const char *tp_engine_scheme(const tp_engine *engine, uint32_t scheme);

/* Compresses the next frame. `top_row` is the first byte of the picture's top row. `pitch` leads to the row
 * below, in bytes; it is negative for pictures stored bottom-up. */
TP_API tp_status tp_engine_push(tp_engine *engine, const void *top_row, ptrdiff_t pitch);

/* The figures of a scheme for the last frame, and their sums over all frames but the first. */
TP_API tp_status tp_engine_statistics(const tp_engine *engine, uint32_t scheme, tp_statistics *out);
TP_API tp_status tp_engine_totals(const tp_engine *engine, uint32_t scheme, tp_statistics *out);
TP_API tp_status tp_engine_frame(const tp_engine *engine, tp_frame *out);
/* The payload bits of each block of the last frame, row by row. `count`: room at `bits`, in elements. */
TP_API tp_status tp_engine_block_bits(const tp_engine *engine, uint32_t scheme, uint16_t *bits, size_t count);

/* Encodes block (bx, by) of the last frame into the caller's memory. Needs keep_blocks. Bits begin at the
 * highest bit of a byte; zeros fill the last byte. 256 bytes hold any payload, 16 bytes any CSB.
 * `payload_bits` and `csb_bits` receive the lengths. */
TP_API tp_status tp_engine_encode_block(const tp_engine *engine, uint32_t scheme, uint32_t bx, uint32_t by,
                                        uint8_t *payload, size_t payload_bytes, uint32_t *payload_bits,
                                        uint8_t *csb, size_t csb_bytes, uint32_t *csb_bits);
/* Writes the tables of the last frame. Needs keep_blocks. `table_bits` receives their length, even if `tables`
 * is NULL or too small. */
TP_API tp_status tp_engine_tables(const tp_engine *engine, uint32_t scheme, uint8_t *tables,
                                  size_t table_bytes, uint64_t *table_bits);

/* Restores blocks from tables, CSB and payload alone. */
typedef struct tp_decoder tp_decoder;

/* `scheme` and `options` as the encoder had them. Returns NULL on failure. */
TP_API tp_decoder *tp_decoder_open(uint32_t format, const char *scheme, const tp_options *options);
TP_API void tp_decoder_close(tp_decoder *decoder); /* NULL is allowed */
/* Begins a frame whose blocks have `csb_bits` status bits each. `tables` holds table_bits bits; NULL for 0. */
TP_API tp_status tp_decoder_begin_frame(tp_decoder *decoder, const uint8_t *tables, uint64_t table_bits,
                                        uint32_t csb_bits);
/* Restores the 64 pixel words of a block, row by row: pixel (x, y) is pixels[8 * y + x]. `payload` holds
 * payload_bits bits; more may follow the block's. `used_bits` receives the bits of the block; may be NULL. */
TP_API tp_status tp_decoder_block(tp_decoder *decoder, uint32_t bx, uint32_t by, const uint8_t *csb,
                                  const uint8_t *payload, uint32_t payload_bits, uint32_t *pixels,
                                  uint32_t *used_bits);

#ifdef __cplusplus
}
#endif

#endif /* TILEPRESS_H */
