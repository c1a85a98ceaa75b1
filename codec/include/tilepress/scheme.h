// Scheme: what every compression scheme offers, one block at a time: measure, encode, decode.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tilepress/bit_io.h"
#include "tilepress/block.h"
#include "tilepress/model_options.h"
#include "tilepress/pixel_format.h"
#include "tilepress/scheme_spec.h"
#include "tilepress/shared_analyses.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// One block. `pixels` is in traversal order (see block.h): position 4s + i is pixel i of sub-block s.
struct BlockContext {
  uint32_t bx = 0, by = 0;           ///< block column and row
  const uint32_t* pixels = nullptr;  ///< 64
  bool uniform = false;              ///< all pixels are equal

  /// Returns the pixels in raster order.
  Block raster() const {
    Block block;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const uint32_t* from = pixels + kSubBlockPixels * sub;
      uint32_t* to = &block.pixels[kTraversal[kSubBlockPixels * sub]];
      std::memcpy(to, from, 2 * sizeof(uint32_t));
      std::memcpy(to + kBlockSide, from + 2, 2 * sizeof(uint32_t));
    }
    return block;
  }
};

/// What a scheme requires of the engine.
struct SchemeNeeds {
  bool first_frame = false;  ///< the surface's first frame affects every later frame
  bool whole_frame = false;  ///< begin_frame() reads the pixels of the plane
  /// The frame before affects a frame through counts that depend on that frame's palette, and so on the frame
  /// before it.
  bool second_frame_before = false;
  bool place = false;        ///< a block's bits depend on its position, not only on its pixels
};

/// A block stored in memory of its own.
struct StoredBlock {
  uint32_t payload_bits;
  uint32_t clean_bytes;  ///< the first so many bytes hold the payload and zeros, nothing from before
};

/// Encoder side. Call subscribe() once, begin_frame() once per frame, then visit blocks in any order.
/// A scheme must have csb_bits() and encode(); the rest has defaults.
class BlockEncoder {
 public:
  virtual ~BlockEncoder() = default;
  virtual SchemeNeeds needs() const { return {}; }
  /// Takes references to the analyses that the scheme uses.
  virtual void subscribe(SharedAnalyses&) {}
  virtual void begin_frame(const FrameContext&) {}
  /// CSB bits of each block of this frame.
  virtual uint32_t csb_bits() const = 0;
  /// Bits of the tables that go with the frame (rCCD, code table): what write_tables() writes.
  virtual uint64_t palette_bits() const { return 0; }
  virtual void write_tables(BitWriter&) const {}
  /// Payload bits that encode() writes. Override it where bits can be counted faster than written.
  virtual uint32_t measure(const BlockContext& block) const {
    std::array<uint8_t, kMaxRawBlockBits / 8> payload_bytes;
    std::array<uint8_t, 16> csb_bytes;
    BitWriter payload(payload_bytes), csb(csb_bytes);
    encode(block, payload, csb);
    return static_cast<uint32_t>(payload.bit_count());
  }
  /// Writes the payload and csb_bits() CSB bits.
  virtual void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const = 0;
  /// Writes the same bits to memory of the block's own. `slot` has whole lines of 64 bytes and room for a raw
  /// block. `csb` has at least 8 bytes and room for csb_bits(); its last byte and its first 8 bytes are
  /// filled up with zeros.
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
  /// After the last block: the figures of the scheme's FVC, if it has one that collected this frame.
  virtual std::optional<FvcFigures> fvc_figures() const { return std::nullopt; }
};

/// Decoder side: restores blocks from tables, CSB and payload alone. Hostile bits return false, never
/// undefined behaviour.
class BlockDecoder {
 public:
  virtual ~BlockDecoder() = default;
  /// Takes the tables of a frame, `table_bits` long (0 = the frame has none), whose blocks have `csb_bits`
  /// CSB bits each. Returns false if no encoder writes such tables.
  virtual bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) = 0;
  /// Restores one block. Returns false if no encoder writes these bits.
  virtual bool decode(BitReader& csb, BitReader& payload, Block& out) const = 0;
  /// The same for a block whose position matters. Schemes with needs_frame_before keep the blocks they
  /// restored, and need one call per block and frame.
  virtual bool decode_at(uint32_t /*bx*/, uint32_t /*by*/, BitReader& csb, BitReader& payload, Block& out) {
    return decode(csb, payload, out);
  }
};

/// What values a key takes.
enum class KeyKind : uint8_t {
  kNumber,      ///< a whole number, low to high
  kPowerOfTwo,  ///< the same, powers of two only
  kShare,       ///< a number from 0 to 1; the default is 0
  kChoice,      ///< one word of `choices`, which are separated by ", "
  kFile,        ///< the path of a file that `read_file` reads; there is no default
};

/// How a range {A..B} of values steps from A to B.
enum class KeyRange : uint8_t { kNone, kDoubling, kCounting };

constexpr uint32_t kLargestNumber = 0x7FFFFFFF;

/// One key of a scheme: how to parse it, and what help prints about it.
struct SchemeKey {
  const char* name;
  KeyKind kind = KeyKind::kNumber;
  const char* summary;
  uint32_t low = 0, high = kLargestNumber;
  uint32_t initial = 0;  ///< the default: a number, or the position of a choice
  const char* choices = "";
  Result<std::vector<uint32_t>> (*read_file)(const std::string& path) = nullptr;
  const char* help_values = nullptr;   ///< replaces values()
  const char* help_initial = nullptr;  ///< replaces default_value()
  const char* zero_word = nullptr;     ///< a word that stands for the value 0
  KeyRange range = KeyRange::kNone;

  /// The values and the default as help prints them, such as "2, 4, 8 ... 1024".
  std::string values() const;
  std::string default_value() const;
};

/// Where a scheme comes from. Help, reports and figures list the schemes group by group, in this order.
enum class SchemeGroup : uint8_t {
  kPaper,       ///< the paper's own schemes and the ones that it compares with
  kLiterature,  ///< published elsewhere
  kHardware,    ///< in shipping GPUs: documented, or reverse engineered
  kOurs,        ///< made for this program, or registered at run time
};
constexpr size_t kSchemeGroups = 4;
/// Returns `paper`, `literature`, `hardware` or `ours`.
const char* name_of(SchemeGroup group);

/// One scheme: everything that the command, the CSV files and the report know about it.
struct SchemeInfo {
  const char* name;    ///< without ':' and ','
  const char* label;   ///< for reports
  const char* family;  ///< schemes of one family stand together in reports
  SchemeGroup group = SchemeGroup::kOurs;
  const char* summary;  ///< one sentence
  const char* source;   ///< paper section or publication
  std::unique_ptr<BlockEncoder> (*make_encoder)(const SchemeSpec&, const FormatTraits&, const ModelOptions&);
  std::unique_ptr<BlockDecoder> (*make_decoder)(const SchemeSpec&, const FormatTraits&, const ModelOptions&);
  std::span<const SchemeKey> keys = {};
  /// Checks rules between keys. `given` lists the keys that the text names. Null: no such rules.
  Result<void> (*check)(const SchemeSpec& spec, std::span<const std::string_view> given) = nullptr;
  /// CSV columns of the scheme's own, at most kOwnCounts together; account() adds to SchemeStatistics::own in
  /// this order. The added columns are the later ones: they stand at the end of a row.
  std::span<const char* const> columns = {};
  std::span<const char* const> added_columns = {};
  /// Both, in the order of SchemeStatistics::own.
  std::vector<const char*> own_columns() const {
    std::vector<const char*> all(columns.begin(), columns.end());
    all.insert(all.end(), added_columns.begin(), added_columns.end());
    return all;
  }
  bool has_dcp_structures = false;  ///< FVC, CCD and rCCD, whose energy the paper states
  bool needs_frame_before = false;  ///< a frame's bits alone do not restore it: use decode_at
  bool eight_bit_only = false;      ///< defined for RGBA8 and RGBX8 pixels only

  /// False: the engine skips the scheme on surfaces of this format, and SurfaceReader refuses them.
  bool supports(PixelFormat format) const {
    return !eight_bit_only || format == PixelFormat::kRgba8 || format == PixelFormat::kRgbx8;
  }
};

/// One line for each scheme that does not support the format: the engine skips it, and it has no rows.
std::vector<std::string> unsupported_schemes(std::span<const SchemeSpec> schemes, PixelFormat format);

/// For SchemeInfo::make_encoder and make_decoder: constructs a T from their parameters.
template <class T>
std::unique_ptr<BlockEncoder> make_encoder(const SchemeSpec& spec, const FormatTraits& format,
                                           const ModelOptions& model) {
  return std::make_unique<T>(spec, format, model);
}
template <class T>
std::unique_ptr<BlockDecoder> make_decoder(const SchemeSpec& spec, const FormatTraits& format,
                                           const ModelOptions& model) {
  return std::make_unique<T>(spec, format, model);
}

/// The schemes of this library, then the ones registered at run time.
const std::deque<SchemeInfo>& scheme_registry();
/// Returns null if there is no such scheme.
const SchemeInfo* find_scheme(std::string_view name);
/// Adds a scheme. Not thread-safe: call it before engines are made and options are parsed. What `info` points
/// to must live until the program ends.
Result<void> register_scheme(const SchemeInfo& info);

}  // namespace tilepress
