// Vector frames: the files of one frame, block by block in the order of commitment.
#include "vectors/vector_frames.h"

#include <algorithm>
#include <array>
#include <utility>

#include "frames/verify_error.h"
#include "streams/output_file.h"
#include "tilepress/tiler.h"
#include "vectors/block_lines.h"
#include "vectors/frame_parameters.h"

namespace tilepress {
namespace {

/// A block in traversal order.
struct ScannedBlock {
  std::array<uint32_t, kBlockPixels> pixels;
  uint64_t mask = 0;                        ///< a bit per pixel, the first highest: 1 = inside the surface
  std::array<uint32_t, kBlockPixels> seen;  ///< the pixels inside
  uint32_t seen_count = 0;
};

void scan_block(const PixelPlane& plane, uint32_t bx, uint32_t by, ScannedBlock& out) {
  Block block;
  plane.load_block(bx, by, block);
  out.mask = 0;
  out.seen_count = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t at = kTraversal[i], x = bx * kBlockSide + at % 8, y = by * kBlockSide + at / 8;
    out.pixels[i] = block.pixels[at];
    const bool inside = x < plane.width() && y < plane.height();
    out.mask = out.mask << 1 | inside;
    if (inside) out.seen[out.seen_count++] = out.pixels[i];
  }
}

Result<void> write_fvc(const std::string& path, const FvcState& state, const VectorFrame& frame) {
  const auto done = write_whole_file(path + ".hex", fvc_lines(state, frame.pixel_bits), false);
  if (!done || !frame.fvc_has_last) return done;
  return write_whole_file(path + "_last.hex", fvc_last_lines(state), false);
}

std::string byte_lines(std::span<const uint8_t> bytes) {
  std::string out;
  for (const uint8_t byte : bytes) {
    append_hex(byte, 2, out);
    out += '\n';
  }
  return out;
}

}  // namespace

/// The files with lines for each block.
class VectorFrames::BlockFiles {
 public:
  Result<void> open(const std::string& folder, bool has_csb) {
    for (const auto& [file, name] : all())
      if (file != &csb_ || has_csb)
        if (const auto opened = file->open(folder + "/" + name, false); !opened) return opened;
    return {};
  }
  void add(const CompressedSurface& surface, uint32_t bx, uint32_t by, const ScannedBlock& block) {
    const uint64_t number = uint64_t{by} * surface.blocks_x() + bx;
    const uint32_t pixel_digits = traits(surface.format).pixel_bits / 4;
    write(places_, uint64_t{by} << 16 | bx, 8);
    for (const uint32_t pixel : block.pixels) write(pixels_, pixel, pixel_digits);
    write(mask_, block.mask, 16);
    write(payload_bits_, surface.block_bits[number], 4);
    const size_t slot_bytes = surface.slot_bytes();
    BitReader payload(std::span(surface.payload).subspan(number * slot_bytes, slot_bytes));
    write(payload_, payload, surface.raw_block_bits());
    if (!csb_.is_open()) return;
    BitReader csb(surface.csb);
    csb.skip(number * surface.csb_bits);
    write(csb_, csb, surface.csb_bits);
  }
  Result<void> commit() {
    for (const auto& [file, name] : all())
      if (file->is_open())
        if (const auto done = file->commit(); !done) return done;
    return {};
  }

 private:
  std::array<std::pair<OutputFile*, const char*>, 6> all() {
    return {{{&places_, "places.hex"},
             {&pixels_, "pixels.hex"},
             {&mask_, "mask.hex"},
             {&csb_, "csb.hex"},
             {&payload_, "payload.hex"},
             {&payload_bits_, "payload_bits.hex"}}};
  }
  void write(OutputFile& file, uint64_t value, uint32_t digits) {
    line_.clear();
    append_hex(value, digits, line_);
    line_ += '\n';
    file.write(line_);
  }
  void write(OutputFile& file, BitReader& bits, uint32_t count) {
    line_.clear();
    append_bits_line(bits, count, line_);
    file.write(line_);
  }
  OutputFile places_, pixels_, mask_, csb_, payload_, payload_bits_;
  std::string line_;
};

VectorFrames::VectorFrames(const SchemeSpec& scheme, const ModelOptions& model, PixelFormat format,
                           BlockWindow window)
    : model_(model),
      window_(window),
      engine_({scheme}, model),
      follower_(FvcFollower::make(scheme, format)) {}

Result<void> VectorFrames::model(const SurfaceView& view, uint64_t number) {
  ordinal_ = engine_.frames();
  number_ = number;
  engine_.process(view, statistics_, std::span(&surface_, 1));
  plane_.assign(view);
  const uint64_t differ = statistics_.schemes.front().mismatched_blocks;
  if (differ > 0) return verify_error(surface_.scheme.text, number, differ);
  return {};
}

Result<VectorFrame> VectorFrames::write(const std::string& folder) {
  FvcState before_frame;
  if (follower_) {
    before_frame = follower_->state();
    follower_->begin_frame(ordinal_);
  }
  const VectorFrame frame = describe();
  if (folder.empty()) {
    pass_blocks(nullptr);
    return frame;
  }
  BlockFiles files;
  if (const auto opened = files.open(folder, frame.csb_bits > 0); !opened) return opened.error();
  const FvcPair states = pass_blocks(&files);
  if (const auto done = files.commit(); !done) return done.error();
  if (follower_)
    if (const auto done = write_dictionaries(folder, frame, before_frame, states); !done) return done.error();
  if (frame.table_bits > 0)
    if (const auto done = write_whole_file(folder + "/tables.hex", byte_lines(surface_.tables), false); !done)
      return done.error();
  const auto done = write_whole_file(folder + "/frame.vh", parameters_text(frame, surface_, states), false);
  if (!done) return done.error();
  return frame;
}

/// Writes the CCD and the states of the FVC. Call it after pass_blocks().
Result<void> VectorFrames::write_dictionaries(const std::string& folder, const VectorFrame& frame,
                                              const FvcState& before_frame, const FvcPair& states) const {
  const std::string ccd = ccd_lines(follower_->ccd(), frame.fvc_entries, frame.pixel_bits);
  if (const auto done = write_whole_file(folder + "/ccd.hex", ccd, false); !done) return done;
  const FvcState after_frame = follower_->state();
  const std::pair<const char*, const FvcState*> named[] = {{"/fvc_before_frame", &before_frame},
                                                           {"/fvc_before_blocks", &states.before_blocks},
                                                           {"/fvc_after_blocks", &states.after_blocks},
                                                           {"/fvc_after_frame", &after_frame}};
  for (const auto& [name, state] : named)
    if (const auto done = write_fvc(folder + name, *state, frame); !done) return done;
  return {};
}

/// Takes every block through the FVC. Returns its states before and after the blocks of the window.
FvcPair VectorFrames::pass_blocks(BlockFiles* files) {
  FvcPair states;
  ScannedBlock block;
  uint64_t at = 0;
  const auto note = [&](FvcState& state) {
    if (follower_) state = follower_->state();
  };
  const auto visit = [&](uint32_t bx, uint32_t by) {
    if (at == window_.first) note(states.before_blocks);
    scan_block(plane_, bx, by, block);
    if (follower_) follower_->see(block.seen.data(), block.seen_count);
    if (files != nullptr && window_.contains(at)) files->add(surface_, bx, by, block);
    if (window_.contains(at) && (at + 1 == plane_.blocks() || !window_.contains(at + 1)))
      note(states.after_blocks);
    ++at;
  };
  for_each_block_in_tiles(plane_.blocks_x(), plane_.blocks_y(), model_.tile_side, visit);
  return states;
}

VectorFrame VectorFrames::describe() const {
  VectorFrame out{.frame = number_,
                  .ordinal = ordinal_,
                  .first = window_.first,
                  .blocks = std::min(window_.count, plane_.blocks() - window_.first),
                  .pixel_bits = traits(surface_.format).pixel_bits,
                  .payload_width = surface_.raw_block_bits(),
                  .csb_bits = surface_.csb_bits,
                  .table_bits = surface_.table_bits};
  if (!follower_) return out;
  out.fvc_entries = follower_->entries();
  out.fvc_collects = follower_->collects(ordinal_);
  out.fvc_has_last = follower_->uses_last();
  out.ccd_colors = static_cast<uint32_t>(follower_->ccd().size());
  return out;
}

}  // namespace tilepress
