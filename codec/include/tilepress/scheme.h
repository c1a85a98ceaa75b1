// Scheme: what every compression scheme offers, one block at a time: measure, encode, decode.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <span>

#include "tilepress/bit_io.h"
#include "tilepress/block.h"
#include "tilepress/pixel_format.h"
#include "tilepress/plane.h"
#include "tilepress/scheme_spec.h"
#include "tilepress/statistics.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

struct Ccd;

constexpr uint16_t kNotInCcd = 0xFFFF;
/// Stands for the width of a sub-block with a pixel that is not in the CCD.
constexpr uint8_t kRawWidth = 0xFF;

/// What a scheme may know when a frame begins.
struct FrameContext {
  const PixelPlane&
      plane;             ///< the frame; its pixels are there yet only for schemes that need the whole frame
  uint64_t ordinal = 0;  ///< 0 = first frame of the surface
  const Ccd* ccd = nullptr;  ///< CCD in force for the scheme's FVC configuration; null while none exists
};

/// One block and what the engine has already found out about it for all schemes. Arrays are in traversal
/// order (see block.h), 64 long: position 4s + i is pixel i of sub-block s.
struct BlockContext {
  const Block& block;                     ///< the block's pixels in raster order, for who needs them so
  uint32_t bx = 0, by = 0;                ///< block column and row
  const uint32_t* pixels = nullptr;       ///< the block's pixels
  bool uniform = false;                   ///< all pixels are equal
  const uint16_t* ccd_indices = nullptr;  ///< CCD index, kNotInCcd where absent; null without a CCD
  const uint8_t* ccd_widths = nullptr;    ///< by sub-block: bit width of its largest index, or kRawWidth
  uint32_t ras_bits = 0;                  ///< RAS stream of the RGBA planes, not rounded
  uint32_t ras_ycocg_bits = 0;            ///< the same of the YCoCg-R planes
};

/// What a scheme wants the engine to compute once for all.
struct SchemeNeeds {
  bool ccd = false;
  bool ras = false;
  bool ras_ycocg = false;
  bool first_frame = false;       ///< depends on the surface's first frame for ever
  bool whole_frame = false;       ///< begin_frame() reads the pixels of the plane
  bool place = false;             ///< what a block takes depends on where it lies, not on its pixels alone
  bool raster = false;            ///< measure() reads BlockContext::block
  bool raster_to_encode = false;  ///< encode() reads BlockContext::block
};

/// A block in memory of its own.
struct StoredBlock {
  uint32_t payload_bits;
  uint32_t clean_bytes;  ///< from the first on these hold the payload and zeros, nothing from before
};

/// Encoder side. begin_frame() once per frame, then any block in any order.
/// encode() writes exactly measure() payload bits and csb_bits() CSB bits.
class BlockEncoder {
 public:
  virtual ~BlockEncoder() = default;
  virtual SchemeNeeds needs() const = 0;
  virtual void begin_frame(const FrameContext& frame) = 0;
  /// CSB bits of each block of this frame.
  virtual uint32_t csb_bits() const = 0;
  /// Bits of the tables that go with the frame (rCCD, code table): what write_tables() writes.
  virtual uint64_t palette_bits() const = 0;
  virtual void write_tables(BitWriter& out) const = 0;
  /// Payload bits of the block.
  virtual uint32_t measure(const BlockContext& block) const = 0;
  virtual void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const = 0;
  /// The same bits from the beginning of memory of the block's own: `slot` as large as a raw block at least,
  /// and in whole lines of 64 bytes, `csb` at least 8 bytes and as many as csb_bits() want, its last byte,
  /// and the first 8 bytes, filled up with zeros.
  virtual StoredBlock store(const BlockContext& block, std::span<uint8_t> slot,
                            std::span<uint8_t> csb) const {
    BitWriter payload(slot), marks(csb);
    encode(block, payload, marks);
    payload.flush();
    marks.flush();
    assert(!payload.overflowed() && !marks.overflowed() && marks.bit_count() == csb_bits());
    const auto bits = static_cast<uint32_t>(payload.bit_count());
    return {bits, (bits + 7) / 8};
  }
  /// Adds what goes beyond the common columns for a block whose payload has `payload_bits`.
  virtual void account(const BlockContext&, uint32_t /*payload_bits*/, SchemeStatistics&) const {}
};

/// Decoder side: from the tables, the CSB and the payload alone. Hostile bits give false, never undefined
/// behaviour.
class BlockDecoder {
 public:
  virtual ~BlockDecoder() = default;
  /// Takes the tables of a frame, `table_bits` long (0 = the frame has none), whose blocks have `csb_bits`
  /// CSB bits each. False: no encoder writes such tables.
  virtual bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) = 0;
  /// Restores one block. False: the bits are not what any encoder writes.
  virtual bool decode(BitReader& csb, BitReader& payload, Block& out) const = 0;
  /// The same for a block whose place matters: schemes with needs_frame_before keep what they restored and
  /// are called once per block and frame.
  virtual bool decode_at(uint32_t /*bx*/, uint32_t /*by*/, BitReader& csb, BitReader& payload, Block& out) {
    return decode(csb, payload, out);
  }
};

/// One line of the registry: everything users are told about a scheme comes from here.
struct SchemeInfo {
  const char* name;
  const char* label;    ///< for reports
  const char* summary;  ///< one sentence
  const char* source;   ///< paper section or publication
  bool takes_fvc_keys;  ///< fvc, policy, ways, sample, period, coverage
  bool takes_ras_keys;  ///< ycocg, sizes
  std::unique_ptr<BlockEncoder> (*make_encoder)(const SchemeSpec&, const FormatTraits&, const ModelOptions&);
  std::unique_ptr<BlockDecoder> (*make_decoder)(const SchemeSpec&, const FormatTraits&, const ModelOptions&);
  bool takes_entries_key = false;   ///< entries
  bool takes_palette_keys = false;  ///< file, from
  bool takes_order_key = false;     ///< order
  bool needs_frame_before = false;  ///< a frame's bits alone do not restore it: use decode_at
};

std::span<const SchemeInfo> scheme_registry();
const SchemeInfo* find_scheme(std::string_view name);

}  // namespace tilepress
