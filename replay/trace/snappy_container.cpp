// Snappy container: 'a' 't', then chunks of a 32-bit little-endian length and a raw snappy block.
#include <snappy.h>

#include <array>
#include <string>
#include <vector>

#include "cut_snappy_block.h"
#include "trace_container.h"
#include "trace_fault.h"

namespace tilepress {
namespace {

constexpr const char* kCutOff = "the last chunk is cut off";

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
