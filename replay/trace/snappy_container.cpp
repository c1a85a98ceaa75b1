// Snappy container: 'a' 't', then chunks of a 32-bit little-endian length and a raw snappy block.
#include <snappy.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "trace_container.h"

namespace tilepress {
namespace {

constexpr const char* kCutOff = "the last chunk is cut off";

/// Recovers the beginning of a block whose end is missing: unpacks the elements (format_description.txt) of a
/// raw snappy block, which begin after its length. Stops at an element that is not whole, does not fit into
/// `plain`, or refers to bytes before it. Returns the bytes unpacked. libsnappy's own function for this
/// writes past the end of its buffer if the block is also damaged.
size_t unpack_cut_block(std::span<const uint8_t> packed, std::span<uint8_t> plain) {
  enum : uint8_t { kLiteral = 0, kCopyNear = 1, kCopyFar = 2 };
  constexpr size_t kLongestInTag = 60;
  size_t in = 0, out = 0;
  while (in < packed.size()) {
    const uint8_t tag = packed[in++];
    const uint8_t kind = tag & 3;
    size_t length = static_cast<size_t>(tag >> 2) + 1;
    size_t field_bytes = kind == kCopyNear ? 1 : kind == kCopyFar ? 2 : 4;
    if (kind == kLiteral) field_bytes = length > kLongestInTag ? length - kLongestInTag : 0;
    if (packed.size() - in < field_bytes) break;
    size_t field = 0;  // the length of a long literal less one, or how far back a copy goes
    for (size_t i = 0; i < field_bytes; ++i) field |= size_t{packed[in++]} << (8 * i);
    if (kind == kLiteral) {
      if (field_bytes > 0) length = field + 1;
      const size_t present = std::min({length, packed.size() - in, plain.size() - out});
      std::copy_n(packed.begin() + static_cast<ptrdiff_t>(in), present,
                  plain.begin() + static_cast<ptrdiff_t>(out));
      in += present;
      out += present;
      if (present < length) break;
      continue;
    }
    if (kind == kCopyNear) {
      length = static_cast<size_t>(tag >> 2 & 7) + 4;
      field |= static_cast<size_t>(tag >> 5) << 8;
    }
    if (field == 0 || field > out || length > plain.size() - out) break;
    for (; length > 0; --length, ++out) plain[out] = plain[out - field];  // may overlap
  }
  return out;
}

class SnappyContainer : public TraceContainer {
 public:
  explicit SnappyContainer(TraceInput& input) : input_(input) {
    std::array<uint8_t, 2> signature;
    input_.read(signature);
  }
  const char* name() const override { return "snappy"; }

  std::span<const uint8_t> next() override {
    size_t length = 0;
    while (length == 0 && read_chunk()) length = unpack_chunk();
    return {plain_.data(), length};
  }

 private:
  /// Reads the next chunk into packed_. Returns false at the end of the file.
  bool read_chunk() {
    if (cut_) fail_truncated(kCutOff);
    std::array<uint8_t, 4> field;
    const size_t field_bytes = input_.read(field);
    if (field_bytes == 0) return false;
    if (field_bytes < field.size()) fail_truncated(kCutOff);
    const uint32_t packed_bytes = field[0] | field[1] << 8 | field[2] << 16 | uint32_t{field[3]} << 24;
    if (packed_bytes > snappy::MaxCompressedLength(kMaxPieceBytes))
      fail_corrupt("a chunk claims " + std::to_string(packed_bytes) + " bytes");
    packed_.resize(packed_bytes);
    packed_.resize(input_.read(packed_));
    cut_ = packed_.size() < packed_bytes;
    return packed_bytes > 0;
  }

  /// Unpacks packed_ into plain_. Returns the bytes unpacked. A program that was killed leaves a file whose
  /// last chunk is cut off: what comes before the cut is good.
  size_t unpack_chunk() {
    const char* packed = reinterpret_cast<const char*>(packed_.data());
    size_t length = 0;
    const bool has_length = snappy::GetUncompressedLength(packed, packed_.size(), &length);
    if (!has_length && cut_) return 0;
    if (!has_length) fail_corrupt("a chunk is no snappy block");
    if (length > kMaxPieceBytes)
      fail_corrupt("a chunk claims to unpack to " + std::to_string(length) + " bytes");
    plain_.resize(length);
    if (cut_) {
      size_t header_bytes = 0;  // the block begins with its unpacked length, 7 bits a byte
      while (packed_[header_bytes++] >= 0x80) {
      }
      return unpack_cut_block(std::span(packed_).subspan(header_bytes), plain_);
    }
    if (!snappy::RawUncompress(packed, packed_.size(), reinterpret_cast<char*>(plain_.data())))
      fail_corrupt("a chunk is damaged");
    return length;
  }

  TraceInput& input_;
  std::vector<uint8_t> packed_, plain_;
  bool cut_ = false;  ///< the file ends inside packed_
};

}  // namespace

std::unique_ptr<TraceContainer> open_snappy_container(TraceInput& input) {
  return std::make_unique<SnappyContainer>(input);
}

}  // namespace tilepress
