// Snappy container: 'a' 't', then chunks of a 32-bit little-endian length and a raw snappy block.
#include <snappy.h>

#include <array>
#include <vector>

#include "cut_snappy_block.h"
#include "trace_container.h"

namespace tilepress {
namespace {

class SnappyContainer : public TraceContainer {
 public:
  explicit SnappyContainer(TraceInput& input) : input_(input) {
    std::array<uint8_t, 2> signature;
    input_.read(signature);
  }
  const char* name() const override { return "snappy"; }

  std::span<const uint8_t> next() override {
    size_t length = 0;
    while (end() == ContainerEnd::kNotReached && length == 0) length = unpack_chunk();
    return {plain_.data(), length};
  }

 private:
  /// Bytes of the next chunk, now in plain_; 0 if it is empty or the end is reached.
  size_t unpack_chunk() {
    if (cut_) return stop(ContainerEnd::kTruncated, "the last chunk is cut off");
    std::array<uint8_t, 4> field;
    const size_t field_bytes = input_.read(field);
    if (field_bytes == 0) return stop(ContainerEnd::kClean, "");
    if (field_bytes < field.size()) return stop(ContainerEnd::kTruncated, "the last chunk is cut off");
    const uint32_t packed_bytes = field[0] | field[1] << 8 | field[2] << 16 | uint32_t{field[3]} << 24;
    if (packed_bytes == 0) return stop(ContainerEnd::kClean, "");
    if (packed_bytes > snappy::MaxCompressedLength(kMaxPieceBytes))
      return stop(ContainerEnd::kCorrupt, "a chunk claims " + std::to_string(packed_bytes) + " bytes");
    packed_.resize(packed_bytes);
    const size_t present = input_.read(packed_);
    const char* packed = reinterpret_cast<const char*>(packed_.data());
    cut_ = present < packed_bytes;
    size_t length = 0;
    if (!snappy::GetUncompressedLength(packed, present, &length))
      return cut_ ? 0 : stop(ContainerEnd::kCorrupt, "a chunk is no snappy block");
    if (length > kMaxPieceBytes)
      return stop(ContainerEnd::kCorrupt, "a chunk claims to unpack to " + std::to_string(length) + " bytes");
    plain_.resize(length);
    if (cut_) {
      // What stands in front of the cut is good: a program that was killed leaves such a file.
      size_t header_bytes = 0;  // the block begins with its unpacked length, 7 bits a byte
      while (packed_[header_bytes++] >= 0x80) {
      }
      return unpack_cut_block(std::span(packed_).subspan(header_bytes, present - header_bytes), plain_);
    }
    if (!snappy::RawUncompress(packed, present, reinterpret_cast<char*>(plain_.data())))
      return stop(ContainerEnd::kCorrupt, "a chunk is damaged");
    return length;
  }

  size_t stop(ContainerEnd end, std::string reason) {
    finish(end, std::move(reason));
    return 0;
  }

  TraceInput& input_;
  std::vector<uint8_t> packed_, plain_;
  bool cut_ = false;
};

}  // namespace

std::unique_ptr<TraceContainer> open_snappy_container(TraceInput& input) {
  return std::make_unique<SnappyContainer>(input);
}

}  // namespace tilepress
