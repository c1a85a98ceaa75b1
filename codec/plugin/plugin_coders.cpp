// Plugin coders: encoder and decoder that call the functions of a plugin's table.
#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "dcp/ccd_view.h"
#include "plugin/plugin_table.h"
#include "tilepress/plugin_scheme.h"

namespace tilepress {
namespace {

constexpr uint32_t kMaxCsbBits = TP_CSB_BYTES * 8;
constexpr uint64_t kMaxTableBits = uint64_t{1} << 27;  ///< 16 MiB

[[noreturn]] void blame(const tp_scheme& table, const std::string& what) {
  throw PluginFault(std::string("scheme '") + table.name + "': the plugin's " + what);
}

/// Appends the first `bits` bits of `bytes`.
void put_bits(std::span<const uint8_t> bytes, uint64_t bits, BitWriter& out) {
  BitReader in(bytes, bits);
  for (uint64_t left = bits; left > 0;) {
    const auto count = static_cast<uint32_t>(std::min<uint64_t>(left, kMaxBitsPerCall));
    out.put(in.get(count), count);
    left -= count;
  }
}

/// Copies the next bits of `in` without consuming them, and zeros behind its end. bytes.size(): whole words.
void copy_bits(BitReader in, std::span<uint8_t> bytes) {
  for (size_t at = 0; at < bytes.size(); at += 8) {
    const uint64_t word = bit_io::big_endian(in.get64());
    std::memcpy(&bytes[at], &word, 8);
  }
}

/// A state of the plugin.
class PluginState {
 public:
  PluginState(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model, bool decodes)
      : table_(plugin_table(spec.name)) {
    std::vector<uint32_t> values;
    for (const auto& [key, value] : spec.values) values.push_back(std::get<uint32_t>(value));
    tp_scheme_setup setup{};
    setup.struct_bytes = sizeof setup;
    const auto* known = std::ranges::find(kFormatTraits, format.name, &FormatTraits::name);
    setup.format = static_cast<uint32_t>(known - std::begin(kFormatTraits));
    setup.pixel_bits = format.pixel_bits;
    std::ranges::copy(format.channel_bits, setup.channel_bits);
    std::ranges::copy(format.channel_shift, setup.channel_shift);
    setup.tile_side = model.tile_side;
    setup.burst_bits = model.burst_bits;
    setup.decodes = decodes ? 1 : 0;
    setup.values = values.data();
    state_ = table_.create(&setup);
    if (state_ == nullptr) blame(table_, "create() returns no state");
  }
  PluginState(const PluginState&) = delete;
  PluginState& operator=(const PluginState&) = delete;
  ~PluginState() {
    if (table_.destroy != nullptr) table_.destroy(state_);
  }
  const tp_scheme& table() const { return table_; }
  void* get() const { return state_; }

 private:
  const tp_scheme& table_;
  void* state_ = nullptr;
};

/// A block in the form of the plugin interface.
struct PluginBlock {
  PluginBlock(const BlockContext& block, const CcdView* view) : raster(block.raster()) {
    c.struct_bytes = sizeof c;
    c.bx = block.bx;
    c.by = block.by;
    c.uniform = block.uniform ? 1 : 0;
    c.pixels = raster.pixels.data();
    if (view == nullptr) return;
    for (uint32_t i = 0; i < kBlockPixels; ++i)
      indices[kTraversal[i]] = view->ccd != nullptr ? view->indices[i] : uint16_t{TP_NO_COLOR};
    c.indices = indices.data();
  }
  Block raster;
  std::array<uint16_t, kBlockPixels> indices;
  tp_scheme_block c{};
};
static_assert(kNotInCcd == TP_NO_COLOR);

class PluginEncoder final : public BlockEncoder {
 public:
  PluginEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : state_(spec, format, model, false), raw_bits_(kBlockPixels * format.pixel_bits) {
    needs_.struct_bytes = sizeof needs_;
    if (table().needs != nullptr) table().needs(state_.get(), &needs_);
    const uint32_t slots = needs_.palette_slots;
    if (slots != 0 && (slots < 2 || slots > 1024 || !std::has_single_bit(slots)))
      blame(table(), "needs() wants a palette of " + std::to_string(slots) +
                         " slots; must be a power of two from 2 to 1024, or 0");
  }

  SchemeNeeds needs() const override {
    return {.first_frame = (needs_.flags & TP_NEEDS_FIRST_FRAME) != 0,
            .whole_frame = (needs_.flags & (TP_NEEDS_WHOLE_FRAME | TP_NEEDS_FIRST_FRAME)) != 0,
            .place = (needs_.flags & TP_NEEDS_PLACE) != 0};
  }
  void subscribe(SharedAnalyses& analyses) override {
    if (needs_.palette_slots == 0) return;
    FvcConfig config;
    config.entries = needs_.palette_slots;
    view_ = &analyses.provided<CcdSource>().view_of(config);
  }
  void begin_frame(const FrameContext& frame) override {
    if (table().begin_frame != nullptr) begin_plugin_frame(frame);
    csb_bits_ = table().csb_bits(state_.get());
    if (csb_bits_ > kMaxCsbBits)
      blame(table(), "csb_bits() returns " + std::to_string(csb_bits_) + ", more than 128");
    table_bits_ = table().table_bits != nullptr ? table().table_bits(state_.get()) : 0;
    if (table_bits_ > kMaxTableBits)
      blame(table(), "table_bits() returns " + std::to_string(table_bits_) + ", more than 2^27");
  }
  uint32_t csb_bits() const override { return csb_bits_; }
  uint64_t palette_bits() const override { return table_bits_; }
  void write_tables(BitWriter& out) const override {
    if (table_bits_ == 0) return;
    std::vector<uint8_t> bytes((table_bits_ + 7) / 8);
    table().write_tables(state_.get(), bytes.data());
    put_bits(bytes, table_bits_, out);
  }
  uint32_t measure(const BlockContext& block) const override {
    if (table().measure == nullptr) return BlockEncoder::measure(block);
    const PluginBlock own(block, view_);
    return checked(table().measure(state_.get(), &own.c), "measure() returns ");
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const PluginBlock own(block, view_);
    // A scheme that writes a little too much must not destroy the program's stack.
    std::array<uint8_t, 8 * TP_PAYLOAD_BYTES> payload_bytes{};
    std::array<uint8_t, 8 * TP_CSB_BYTES> csb_bytes{};
    const uint32_t bits = checked(
        table().encode(state_.get(), &own.c, payload_bytes.data(), csb_bytes.data()), "encode() writes ");
    put_bits(payload_bytes, bits, payload);
    put_bits(csb_bytes, csb_bits_, csb);
  }
  void account(const BlockContext& block, uint32_t payload_bits,
               SchemeStatistics& statistics) const override {
    if (table().account == nullptr || table().column_count == 0) return;
    const PluginBlock own(block, view_);
    table().account(state_.get(), &own.c, payload_bits, statistics.own.data());
  }

 private:
  const tp_scheme& table() const { return state_.table(); }
  uint32_t checked(uint32_t bits, const char* what) const {
    if (bits > raw_bits_)
      blame(table(), what + std::to_string(bits) + " bits; a block has at most " + std::to_string(raw_bits_));
    return bits;
  }
  void begin_plugin_frame(const FrameContext& frame) {
    tp_scheme_frame own{};
    own.struct_bytes = sizeof own;
    own.width = frame.plane.width();
    own.height = frame.plane.height();
    own.blocks_x = frame.plane.blocks_x();
    own.blocks_y = frame.plane.blocks_y();
    own.ordinal = frame.ordinal;
    if (view_ != nullptr && view_->ccd != nullptr) {
      own.palette = view_->ccd->colors.data();
      own.palette_colors = static_cast<uint32_t>(view_->ccd->colors.size());
    }
    if (needs().whole_frame) {
      own.pixels = frame.plane.row(0);
      own.stride = frame.plane.stride();
    }
    table().begin_frame(state_.get(), &own);
  }

  const PluginState state_;
  const uint32_t raw_bits_;
  tp_scheme_needs needs_{};
  const CcdView* view_ = nullptr;  ///< null without a palette
  uint32_t csb_bits_ = 0;
  uint64_t table_bits_ = 0;
};

class PluginDecoder final : public BlockDecoder {
 public:
  PluginDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : state_(spec, format, model, true), raw_bits_(kBlockPixels * format.pixel_bits) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    if (table_bits > kMaxTableBits || csb_bits > kMaxCsbBits) return false;
    csb_bits_ = csb_bits;
    if (state_.table().begin_decoding == nullptr) return table_bits == 0;
    std::vector<uint8_t> bytes((table_bits + 63) / 64 * 8);
    copy_bits(tables, bytes);
    tables.skip(table_bits);
    return !tables.overran() &&
           state_.table().begin_decoding(state_.get(), bytes.data(), table_bits, csb_bits) != 0;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    return decode_block(0, 0, csb, payload, out);
  }
  bool decode_at(uint32_t bx, uint32_t by, BitReader& csb, BitReader& payload, Block& out) override {
    return decode_block(bx, by, csb, payload, out);
  }

 private:
  bool decode_block(uint32_t bx, uint32_t by, BitReader& csb, BitReader& payload, Block& out) const {
    std::array<uint8_t, TP_PAYLOAD_BYTES> payload_bytes;
    std::array<uint8_t, TP_CSB_BYTES> csb_bytes{};
    copy_bits(payload, payload_bytes);
    BitWriter marks(csb_bytes);
    for (uint32_t left = csb_bits_; left > 0;) {
      const uint32_t count = std::min(left, kMaxBitsPerCall);
      marks.put(csb.get(count), count);
      left -= count;
    }
    marks.flush();
    const uint32_t used = state_.table().decode(state_.get(), bx, by, csb_bytes.data(), payload_bytes.data(),
                                                out.pixels.data());
    if (used > raw_bits_) return false;  // TP_BAD_BLOCK as well
    payload.skip(used);
    return !csb.overran() && !payload.overran();
  }

  const PluginState state_;
  const uint32_t raw_bits_;
  uint32_t csb_bits_ = 0;
};

}  // namespace

std::unique_ptr<BlockEncoder> make_plugin_encoder(const SchemeSpec& spec, const FormatTraits& format,
                                                  const ModelOptions& model) {
  return std::make_unique<PluginEncoder>(spec, format, model);
}

std::unique_ptr<BlockDecoder> make_plugin_decoder(const SchemeSpec& spec, const FormatTraits& format,
                                                  const ModelOptions& model) {
  return std::make_unique<PluginDecoder>(spec, format, model);
}

}  // namespace tilepress
