// Block harness: one scheme, one dictionary, one block at a time, with the bits in the open.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "dcp/ccd_view.h"
#include "dcp/index_widths.h"
#include "surface_patterns.h"
#include "tilepress/scheme.h"

namespace harness {

using namespace tilepress;

inline SchemeSpec parsed(const std::string& text) {
  auto spec = parse_scheme(text);
  if (!spec) throw std::runtime_error(spec.error().text);
  return *spec;
}

/// A block and the bits that stand for it.
struct Encoded {
  std::vector<uint8_t> payload, csb;
  uint32_t payload_bits = 0, csb_bits = 0;
  BitReader read_payload() const { return BitReader(payload, payload_bits); }
  BitReader read_csb() const { return BitReader(csb, csb_bits); }
};

/// A CCD of `entries` slots that holds `colors` in this order.
inline Ccd dictionary(uint32_t entries, const std::vector<uint32_t>& colors) {
  Ccd ccd;
  ccd.entries = entries;
  ccd.colors = colors;
  for (size_t i = 0; i < colors.size(); ++i)
    ccd.counts.push_back(static_cast<uint32_t>(2 * colors.size() - i));
  for (const uint32_t count : ccd.counts) ccd.samples += count;
  ccd.coverage = 1;
  return ccd;
}

inline Block solid(uint32_t color) {
  Block block;
  block.pixels.fill(color);
  return block;
}

class BlockHarness {
 public:
  /// `ccd` null: no dictionary yet.
  BlockHarness(const std::string& text, const Ccd* ccd, PixelFormat format = PixelFormat::kRgba8,
               const ModelOptions& model = {})

      : pixel_format_(format), format_(traits(format)), has_ccd_(ccd != nullptr), analyses_(format_) {
    if (ccd != nullptr) ccd_ = *ccd;
    const SchemeSpec spec = parsed(text);
    const SchemeInfo* info = find_scheme(spec.name);
    encoder_ = info->make_encoder(spec, format_, model);
    decoder_ = info->make_decoder(spec, format_, model);
    const reference::Picture picture{8, 8, std::vector<uint32_t>(64)};
    plane_.assign(patterns::in_memory(picture, format).view());
    analyses_.provide<CcdSource>(dictionary_);
    encoder_->subscribe(analyses_);
    if (has_ccd_) dictionary_.view.ccd = &ccd_;
    const std::vector<uint8_t> changed(1, 1);
    const FrameContext frame{plane_, has_ccd_ ? 1u : 0u, changed.data()};
    analyses_.for_each([&](BlockAnalysis& analysis) { analysis.begin_frame(frame); });
    encoder_->begin_frame(frame);
    tables_.resize((encoder_->palette_bits() + 7) / 8);
    BitWriter writer(tables_);
    encoder_->write_tables(writer);
    writer.flush();
    tables_written_ = writer.bit_count();
    BitReader reader(tables_, tables_written_);
    tables_accepted_ = decoder_->begin_frame(reader, tables_written_, encoder_->csb_bits());
  }

  uint32_t measure(const Block& block) const { return encoder_->measure(Seen(*this, block).context); }
  Encoded encode(const Block& block) const {
    Encoded out;
    out.payload.resize(kMaxRawBlockBits / 8);
    out.csb.resize(16);
    BitWriter payload(out.payload), csb(out.csb);
    encoder_->encode(Seen(*this, block).context, payload, csb);
    payload.flush();
    csb.flush();
    out.payload_bits = static_cast<uint32_t>(payload.bit_count());
    out.csb_bits = static_cast<uint32_t>(csb.bit_count());
    return out;
  }
  bool decode(const Encoded& bits, Block& out) const {
    BitReader csb = bits.read_csb(), payload = bits.read_payload();
    return decoder_->decode(csb, payload, out);
  }
  /// Decodes what encode() wrote and compares.
  bool returns(const Block& block) const {
    Block out;
    out.pixels.fill(0xDEADBEEF);
    const Encoded bits = encode(block);
    return bits.payload_bits == measure(block) && bits.csb_bits == encoder_->csb_bits() &&
           decode(bits, out) && out == block;
  }
  const BlockEncoder& encoder() const { return *encoder_; }
  BlockDecoder& decoder() { return *decoder_; }
  uint64_t tables_written() const { return tables_written_; }
  bool tables_accepted() const { return tables_accepted_; }

 private:
  /// What the engine would tell the scheme about a block, found out by plain loops.
  struct Seen {
    Seen(const BlockHarness& owner, const Block& block) {
      const auto& colors = owner.ccd_.colors;
      for (uint32_t i = 0; i < kBlockPixels; ++i) {
        pixels[i] = block.pixels[kTraversal[i]];
        const auto at = std::find(colors.begin(), colors.end(), pixels[i]);
        indices[i] = at == colors.end() ? kNotInCcd : static_cast<uint16_t>(at - colors.begin());
      }
      for (uint32_t sub = 0; sub < kSubBlocks; ++sub)
        widths[sub] = width_of(*std::max_element(indices.begin() + sub * 4, indices.begin() + sub * 4 + 4));
      context.pixels = pixels.data();
      context.uniform = std::count(pixels.begin(), pixels.end(), pixels[0]) == kBlockPixels;
      owner.dictionary_.view.indices = indices.data();
      owner.dictionary_.view.widths = widths.data();
      owner.show(block, context);
    }
    std::array<uint32_t, kBlockPixels> pixels;
    std::array<uint16_t, kBlockPixels> indices;
    std::array<uint8_t, kSubBlocks> widths;
    BlockContext context;
  };
  /// The dictionary and the look-up of the block at hand.
  struct Dictionary final : CcdSource {
    const CcdView& view_of(const FvcConfig&) override { return view; }
    CcdView view;
  };
  /// Lets the other analyses see a block, as a frame of that block alone.
  void show(const Block& block, const BlockContext& context) const {
    reference::Picture picture{8, 8, {block.pixels.begin(), block.pixels.end()}};
    plane_.assign(patterns::in_memory(picture, pixel_format_).view());
    const std::vector<uint8_t> changed(1, 1);
    analyses_.for_each([&](BlockAnalysis& analysis) {
      analysis.begin_frame({plane_, 0, changed.data()});
      analysis.see_block(context);
    });
  }
  const PixelFormat pixel_format_;
  const FormatTraits format_;
  const bool has_ccd_;
  Ccd ccd_;
  mutable PixelPlane plane_;
  mutable SharedAnalyses analyses_;
  mutable Dictionary dictionary_;
  std::unique_ptr<BlockEncoder> encoder_;
  std::unique_ptr<BlockDecoder> decoder_;
  std::vector<uint8_t> tables_;
  uint64_t tables_written_ = 0;
  bool tables_accepted_ = false;
};

}  // namespace harness
