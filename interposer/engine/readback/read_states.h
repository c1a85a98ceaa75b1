// Read states: every state of a GL context that a read of colours heeds, in OpenGL 1.0 to 4.6 and OpenGL ES
// 1.0 to 3.2. C, because the sample program that makes each state hostile is C.
//
// Not in the table, and why:
// - Scissor, masks, sample coverage, rasterizer discard, conditional rendering, GL_FRAMEBUFFER_SRGB, queries,
//   transform feedback: drawing, clears and glBlitFramebuffer heed them, glReadPixels does not.
// - Pixel zoom and raster position: glDrawPixels, glBitmap and glCopyPixels heed them.
// - glPixelMap tables, colour tables, filters, histogram, minmax: no effect while their switch below is off.
// - Render mode: glReadPixels is the same in GL_SELECT and GL_FEEDBACK.
#pragma once

/// How a state is saved and set.
typedef enum {
  kReadDisplayList,   ///< glGetIntegerv; never set. Unless it is 0, only kReadPack and kReadPackBuffer can be
                      ///< set: other setters are compiled into the program's list
  kReadCapability,    ///< glIsEnabled; glEnable, glDisable
  kReadPack,          ///< glGetIntegerv; glPixelStorei
  kReadTransfer,      ///< glGetIntegerv; glPixelTransferi
  kReadTransferReal,  ///< glGetFloatv; glPixelTransferf
  kReadColorMatrix,   ///< glGetFloatv, 16 values; glLoadMatrixf in matrix mode GL_COLOR. Neutral: identity
  kReadClamp,         ///< glGetIntegerv; glClampColor
  kReadPackBuffer,    ///< glGetIntegerv; glBindBuffer(GL_PIXEL_PACK_BUFFER)
  kReadFramebuffer,   ///< glGetIntegerv; glBindFramebuffer. Neutral: what is read. Where reading and drawing
                      ///< share one binding, GL_FRAMEBUFFER_BINDING
  kReadBuffer,        ///< glGetIntegerv; glReadBuffer. Neutral: what is read
} read_state_kind;

/// A context has the state if its version is at least `desktop` or `embedded` (10 · major + minor, 0 = no
/// version has it), or if it has one of `extensions`, separated by blanks.
typedef struct {
  const char* name;
  unsigned gl_name;
  read_state_kind kind;
  int neutral;
  int desktop, embedded;
  const char* extensions;
  int legacy;  ///< core profiles lack the state
} read_state;

#define PACK_SUBIMAGE "GL_NV_pack_subimage"
#define PACK_COMPRESSED "GL_ARB_compressed_texture_pixel_storage"
#define PACK_BUFFERS "GL_ARB_pixel_buffer_object GL_EXT_pixel_buffer_object GL_NV_pixel_buffer_object"
#define FRAMEBUFFERS "GL_ARB_framebuffer_object GL_EXT_framebuffer_object GL_OES_framebuffer_object"
#define IMAGING "GL_ARB_imaging"
#define PACK(name, number, desktop, embedded, extensions) \
  { name, number, kReadPack, 0, desktop, embedded, extensions, 0 }
#define TRANSFER(name, number) \
  { name, number, kReadTransfer, 0, 10, 0, "", 1 }
#define TRANSFER_REAL(name, number, neutral) \
  { name, number, kReadTransferReal, neutral, 10, 0, "", 1 }
#define IMAGING_REAL(name, number, neutral) \
  { name, number, kReadTransferReal, neutral, 0, 0, IMAGING, 1 }
#define IMAGING_SWITCH(name, number) \
  { name, number, kReadCapability, 0, 0, 0, IMAGING, 1 }

/// In the order in which they are set. They are put back in the reverse order. Debug output comes first, so
/// that no other change is reported. A read buffer comes after the framebuffer, because it belongs to the
/// bound one.
static const read_state kReadStates[] = {
    {"LIST_INDEX", 0x0B33, kReadDisplayList, 0, 10, 0, "", 1},
    {"DEBUG_OUTPUT", 0x92E0, kReadCapability, 0, 43, 32, "GL_KHR_debug", 0},
    {"READ_FRAMEBUFFER_BINDING", 0x8CAA, kReadFramebuffer, 0, 30, 20, FRAMEBUFFERS, 0},
    {"READ_BUFFER", 0x0C02, kReadBuffer, 0, 10, 30, "GL_NV_read_buffer", 0},
    {"PIXEL_PACK_BUFFER_BINDING", 0x88ED, kReadPackBuffer, 0, 21, 30, PACK_BUFFERS, 0},
    {"PACK_ALIGNMENT", 0x0D05, kReadPack, 1, 10, 10, "", 0},
    PACK("PACK_SWAP_BYTES", 0x0D00, 10, 0, ""),
    PACK("PACK_LSB_FIRST", 0x0D01, 10, 0, ""),
    PACK("PACK_ROW_LENGTH", 0x0D02, 10, 30, PACK_SUBIMAGE),
    PACK("PACK_SKIP_ROWS", 0x0D03, 10, 30, PACK_SUBIMAGE),
    PACK("PACK_SKIP_PIXELS", 0x0D04, 10, 30, PACK_SUBIMAGE),
    PACK("PACK_SKIP_IMAGES", 0x806B, 12, 0, ""),
    PACK("PACK_IMAGE_HEIGHT", 0x806C, 12, 0, ""),
    PACK("PACK_COMPRESSED_BLOCK_WIDTH", 0x912B, 42, 0, PACK_COMPRESSED),
    PACK("PACK_COMPRESSED_BLOCK_HEIGHT", 0x912C, 42, 0, PACK_COMPRESSED),
    PACK("PACK_COMPRESSED_BLOCK_DEPTH", 0x912D, 42, 0, PACK_COMPRESSED),
    PACK("PACK_COMPRESSED_BLOCK_SIZE", 0x912E, 42, 0, PACK_COMPRESSED),
    PACK("PACK_INVERT_MESA", 0x8758, 0, 0, "GL_MESA_pack_invert"),
    PACK("PACK_REVERSE_ROW_ORDER_ANGLE", 0x93A4, 0, 0, "GL_ANGLE_pack_reverse_row_order"),
    PACK("PACK_ROW_BYTES_APPLE", 0x8A15, 0, 0, "GL_APPLE_row_bytes"),
    {"CLAMP_READ_COLOR", 0x891C, kReadClamp, 0x891D /* GL_FIXED_ONLY */, 30, 0, "GL_ARB_color_buffer_float",
     0},
    TRANSFER("MAP_COLOR", 0x0D10),
    TRANSFER("MAP_STENCIL", 0x0D11),
    TRANSFER("INDEX_SHIFT", 0x0D12),
    TRANSFER("INDEX_OFFSET", 0x0D13),
    TRANSFER_REAL("RED_SCALE", 0x0D14, 1),
    TRANSFER_REAL("RED_BIAS", 0x0D15, 0),
    TRANSFER_REAL("GREEN_SCALE", 0x0D18, 1),
    TRANSFER_REAL("GREEN_BIAS", 0x0D19, 0),
    TRANSFER_REAL("BLUE_SCALE", 0x0D1A, 1),
    TRANSFER_REAL("BLUE_BIAS", 0x0D1B, 0),
    TRANSFER_REAL("ALPHA_SCALE", 0x0D1C, 1),
    TRANSFER_REAL("ALPHA_BIAS", 0x0D1D, 0),
    TRANSFER_REAL("DEPTH_SCALE", 0x0D1E, 1),
    TRANSFER_REAL("DEPTH_BIAS", 0x0D1F, 0),
    IMAGING_SWITCH("COLOR_TABLE", 0x80D0),
    IMAGING_SWITCH("POST_CONVOLUTION_COLOR_TABLE", 0x80D1),
    IMAGING_SWITCH("POST_COLOR_MATRIX_COLOR_TABLE", 0x80D2),
    IMAGING_SWITCH("CONVOLUTION_1D", 0x8010),
    IMAGING_SWITCH("CONVOLUTION_2D", 0x8011),
    IMAGING_SWITCH("SEPARABLE_2D", 0x8012),
    IMAGING_SWITCH("HISTOGRAM", 0x8024),
    IMAGING_SWITCH("MINMAX", 0x802E),
    {"COLOR_MATRIX", 0x80B1, kReadColorMatrix, 1, 0, 0, IMAGING, 1},
    IMAGING_REAL("POST_CONVOLUTION_RED_SCALE", 0x801C, 1),
    IMAGING_REAL("POST_CONVOLUTION_GREEN_SCALE", 0x801D, 1),
    IMAGING_REAL("POST_CONVOLUTION_BLUE_SCALE", 0x801E, 1),
    IMAGING_REAL("POST_CONVOLUTION_ALPHA_SCALE", 0x801F, 1),
    IMAGING_REAL("POST_CONVOLUTION_RED_BIAS", 0x8020, 0),
    IMAGING_REAL("POST_CONVOLUTION_GREEN_BIAS", 0x8021, 0),
    IMAGING_REAL("POST_CONVOLUTION_BLUE_BIAS", 0x8022, 0),
    IMAGING_REAL("POST_CONVOLUTION_ALPHA_BIAS", 0x8023, 0),
    IMAGING_REAL("POST_COLOR_MATRIX_RED_SCALE", 0x80B4, 1),
    IMAGING_REAL("POST_COLOR_MATRIX_GREEN_SCALE", 0x80B5, 1),
    IMAGING_REAL("POST_COLOR_MATRIX_BLUE_SCALE", 0x80B6, 1),
    IMAGING_REAL("POST_COLOR_MATRIX_ALPHA_SCALE", 0x80B7, 1),
    IMAGING_REAL("POST_COLOR_MATRIX_RED_BIAS", 0x80B8, 0),
    IMAGING_REAL("POST_COLOR_MATRIX_GREEN_BIAS", 0x80B9, 0),
    IMAGING_REAL("POST_COLOR_MATRIX_BLUE_BIAS", 0x80BA, 0),
    IMAGING_REAL("POST_COLOR_MATRIX_ALPHA_BIAS", 0x80BB, 0),
};

#undef PACK_SUBIMAGE
#undef PACK_COMPRESSED
#undef PACK_BUFFERS
#undef FRAMEBUFFERS
#undef IMAGING
#undef PACK
#undef TRANSFER
#undef TRANSFER_REAL
#undef IMAGING_REAL
#undef IMAGING_SWITCH

enum { kReadStateCount = sizeof kReadStates / sizeof *kReadStates };
