/* A C program that uses the installed library: figures, blocks there and back, errors, structures of other versions.
 * Usage: c_user FRAMES.rgba WIDTH HEIGHT SCHEMES. Prints the figures of each frame but the first as the rows of
 * tests/golden/expected.csv. Exit status 0 if all is as it should be. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tilepress.h>

#define EXPECT(condition)                                                                  \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      fprintf(stderr, "c_user:%d: not so: %s (%s)\n", __LINE__, #condition, tp_error());   \
      exit(1);                                                                             \
    }                                                                                      \
  } while (0)

enum { kFrames = 3 };
static uint32_t width, height;
static uint8_t *frames[kFrames];

static void read_frames(const char *path) {
  FILE *file = fopen(path, "rb");
  EXPECT(file != NULL);
  for (int i = 0; i < kFrames; ++i) {
    const size_t bytes = (size_t)4 * width * height;
    frames[i] = malloc(bytes);
    EXPECT(frames[i] != NULL && fread(frames[i], 1, bytes, file) == bytes);
  }
  fclose(file);
}

static void print_figures(const tp_engine *engine, int frame) {
  for (uint32_t i = 0; i < tp_engine_scheme_count(engine); ++i) {
    tp_statistics figures = {.struct_bytes = sizeof figures};
    EXPECT(tp_engine_statistics(engine, i, &figures) == TP_OK);
    EXPECT(figures.mismatched_blocks == 0 && figures.checked_blocks == figures.blocks);
    printf("odd,,%d,%s,%llu,%llu,%llu,%llu\n", frame, tp_engine_scheme(engine, i),
           (unsigned long long)figures.payload_bits, (unsigned long long)figures.bursts,
           (unsigned long long)figures.csb_bits, (unsigned long long)figures.table_bits);
  }
}

/* Block (bx, by) of a frame as the engine sees it: its edge repeats the nearest pixel. */
static uint32_t pixel_of(int frame, uint32_t x, uint32_t y) {
  x = x < width ? x : width - 1;
  y = y < height ? y : height - 1;
  const uint8_t *at = frames[frame] + 4 * ((size_t)width * y + x);
  return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static void check_blocks(const tp_engine *engine, int frame, uint32_t scheme) {
  static uint8_t tables[1 << 16], payload[256], csb[16];
  static uint16_t known_bits[1 << 13];
  tp_frame shape = {.struct_bytes = sizeof shape};
  uint64_t table_bits, sum = 0;
  uint32_t payload_bits, csb_bits, used, pixels[64];
  tp_decoder *decoder = tp_decoder_open(TP_RGBA8, tp_engine_scheme(engine, scheme), NULL);
  EXPECT(decoder != NULL);
  EXPECT(tp_engine_frame(engine, &shape) == TP_OK && shape.blocks_x == (width + 7) / 8);
  EXPECT(shape.number == (uint64_t)frame && shape.entropy > 0 && shape.raw_block_bits == 2048);
  EXPECT(tp_engine_block_bits(engine, scheme, known_bits, sizeof known_bits / sizeof known_bits[0]) == TP_OK);
  EXPECT(tp_engine_tables(engine, scheme, tables, sizeof tables, &table_bits) == TP_OK);
  for (uint32_t by = 0; by < shape.blocks_y; ++by)
    for (uint32_t bx = 0; bx < shape.blocks_x; ++bx) {
      EXPECT(tp_engine_encode_block(engine, scheme, bx, by, payload, sizeof payload, &payload_bits, csb, sizeof csb,
                                    &csb_bits) == TP_OK);
      EXPECT(payload_bits == known_bits[by * shape.blocks_x + bx]);
      if (bx + by == 0) EXPECT(tp_decoder_begin_frame(decoder, tables, table_bits, csb_bits) == TP_OK);
      EXPECT(tp_decoder_block(decoder, bx, by, csb, payload, payload_bits, pixels, &used) == TP_OK);
      EXPECT(used == payload_bits);
      for (uint32_t i = 0; i < 64; ++i) EXPECT(pixels[i] == pixel_of(frame, 8 * bx + i % 8, 8 * by + i / 8));
      sum += payload_bits;
      if (payload_bits == 0) continue;  /* one bit is missing: an error or other pixels, never a crash */
      const tp_status torn = tp_decoder_block(decoder, bx, by, csb, payload, payload_bits - 1, pixels, NULL);
      EXPECT(torn == TP_BAD_BITS);
    }
  tp_statistics figures = {.struct_bytes = sizeof figures};
  EXPECT(tp_engine_statistics(engine, scheme, &figures) == TP_OK && figures.payload_bits == sum);
  EXPECT(figures.rate > 1 && figures.rate <= figures.rate_payload);
  tp_decoder_close(decoder);
}

#define REFUSED(status, call) EXPECT((call) == (status) && tp_error()[0] != '\0' && tp_error_status() == (status))
#define NO_ENGINE(status, ...) \
  EXPECT(tp_engine_open(__VA_ARGS__) == NULL && tp_error()[0] != '\0' && tp_error_status() == (status))

static void check_errors(tp_engine *engine) {
  tp_options bad = {.struct_bytes = sizeof bad, .tile_side = 12};
  tp_statistics figures = {.struct_bytes = 0};
  uint8_t payload[256], csb[16];
  uint16_t bits[4];
  uint32_t payload_bits, csb_bits, pixels[64];
  uint64_t table_bits;
  NO_ENGINE(TP_BAD_ARGUMENT, 0, 10, TP_RGBA8, "vdcp", NULL);
  NO_ENGINE(TP_BAD_ARGUMENT, 10, 65536, TP_RGBA8, "vdcp", NULL);
  NO_ENGINE(TP_BAD_ARGUMENT, 10, 10, 77, "vdcp", NULL);
  NO_ENGINE(TP_BAD_ARGUMENT, 10, 10, TP_BGRX8 + 1, "vdcp", NULL);
  NO_ENGINE(TP_BAD_ARGUMENT, 10, 10, TP_RGBA8, NULL, NULL);
  NO_ENGINE(TP_BAD_ARGUMENT, 10, 10, TP_RGBA8, "vdcp", &bad);
  NO_ENGINE(TP_BAD_SCHEME, 10, 10, TP_RGBA8, " ", NULL);
  NO_ENGINE(TP_BAD_SCHEME, 10, 10, TP_RGBA8, "vdcp:fvc=3", NULL);
  NO_ENGINE(TP_BAD_SCHEME, 10, 10, TP_RGBA8, "zip", NULL);
  EXPECT(strstr(tp_error(), "unknown scheme 'zip'") != NULL && strchr(tp_error(), '\n') == NULL);
  REFUSED(TP_BAD_ARGUMENT, tp_engine_push(NULL, frames[0], 4));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_push(engine, NULL, 4 * width));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_push(engine, frames[0], 4 * width - 1));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_statistics(engine, 0, &figures));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_statistics(engine, 0, NULL));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_statistics(engine, 99, &figures));
  REFUSED(TP_NO_SPACE, tp_engine_block_bits(engine, 0, bits, 4));
  REFUSED(TP_NO_SPACE, tp_engine_tables(engine, 0, NULL, 0, &table_bits));
  EXPECT(table_bits > 0);
  REFUSED(TP_NO_SPACE, tp_engine_encode_block(engine, 0, 0, 0, payload, 0, &payload_bits, csb, 0, &csb_bits));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_encode_block(engine, 0, 99, 0, payload, 256, &payload_bits, csb, 16, &csb_bits));
  REFUSED(TP_BAD_ARGUMENT, tp_engine_encode_block(engine, 0, 0, 0, NULL, 256, &payload_bits, csb, 16, &csb_bits));
  EXPECT(tp_decoder_open(TP_RGBA8, "zip", NULL) == NULL && tp_error_status() == TP_BAD_SCHEME);
  EXPECT(tp_decoder_open(TP_RGB565, "intel8", NULL) == NULL && tp_error_status() == TP_UNSUPPORTED);
  tp_decoder *decoder = tp_decoder_open(TP_RGBA8, "vdcp", NULL);
  REFUSED(TP_NO_FRAME, tp_decoder_block(decoder, 0, 0, csb, payload, 8, pixels, NULL));
  REFUSED(TP_BAD_BITS, tp_decoder_begin_frame(decoder, payload, 5, 48));
  REFUSED(TP_BAD_BITS, tp_decoder_begin_frame(decoder, payload, 0, 4000));
  REFUSED(TP_BAD_ARGUMENT, tp_decoder_begin_frame(decoder, NULL, 5, 48));
  EXPECT(tp_decoder_begin_frame(decoder, NULL, 0, 48) == TP_OK);
  REFUSED(TP_BAD_ARGUMENT, tp_decoder_block(decoder, 0, 0, NULL, payload, 8, pixels, NULL));
  tp_decoder_close(decoder);
  tp_decoder_close(NULL);
  tp_engine_close(NULL);
  EXPECT(tp_engine_scheme_count(NULL) == 0 && tp_engine_scheme(engine, 99) == NULL);
  REFUSED(TP_BAD_ARGUMENT, tp_register_scheme(NULL));
  tp_scheme other = *tilepress_scheme(0);
  other.abi = 99;
  REFUSED(TP_BAD_SCHEME, tp_register_scheme(&other));
}

/* Programs of an older and of a newer header: shorter and longer structures. */
static void check_versions(const tp_engine *engine) {
  struct {
    tp_statistics known;
    uint64_t later;
  } longer = {.known = {.struct_bytes = sizeof longer}, .later = 5};
  struct {
    tp_options known;
    uint64_t later;
  } wish = {.known = {.struct_bytes = sizeof wish}, .later = 1};
  tp_statistics shorter;
  memset(&shorter, 0xAB, sizeof shorter);
  shorter.struct_bytes = offsetof(tp_statistics, payload_bits);
  EXPECT(tp_version() / 10000 == TP_VERSION_MAJOR && tp_version() >= 100 * TP_VERSION_MINOR);
  EXPECT(tp_engine_statistics(engine, 0, &longer.known) == TP_OK && longer.later == 0 && longer.known.rate > 1);
  EXPECT(tp_engine_statistics(engine, 0, &shorter) == TP_OK && shorter.raw_bits == longer.known.raw_bits);
  EXPECT(shorter.payload_bits == 0xABABABABABABABABu);
  NO_ENGINE(TP_BAD_ARGUMENT, 10, 10, TP_RGBA8, "vdcp", &wish.known);
}

int main(int argc, char **argv) {
  EXPECT(argc == 5);
  width = (uint32_t)atoi(argv[2]);
  height = (uint32_t)atoi(argv[3]);
  read_frames(argv[1]);
  EXPECT(tp_register_scheme(tilepress_scheme(0)) == TP_OK);
  tp_options options = {.struct_bytes = sizeof options, .verify = 1, .keep_blocks = 1};
  tp_engine *engine = tp_engine_open(width, height, TP_RGBA8, argv[4], &options);
  tp_engine *plugin = tp_engine_open(width, height, TP_RGBA8, "rowpal rowpal:slots=64", &options);
  EXPECT(engine != NULL && plugin != NULL);
  tp_statistics none = {.struct_bytes = sizeof none};
  REFUSED(TP_NO_FRAME, tp_engine_statistics(engine, 0, &none));
  for (int frame = 0; frame < kFrames; ++frame) {
    EXPECT(tp_engine_push(engine, frames[frame], 4 * width) == TP_OK);
    EXPECT(tp_engine_push(plugin, frames[frame], 4 * width) == TP_OK);
    if (frame > 0) print_figures(engine, frame);
  }
  for (uint32_t scheme = 0; scheme < tp_engine_scheme_count(engine); ++scheme)
    check_blocks(engine, kFrames - 1, scheme);
  check_blocks(plugin, kFrames - 1, 0);
  check_blocks(plugin, kFrames - 1, 1);
  check_errors(engine);
  check_versions(engine);
  tp_engine_close(engine);
  tp_engine_close(plugin);
  for (int i = 0; i < kFrames; ++i) free(frames[i]);
  return 0;
}
