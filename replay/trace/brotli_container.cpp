// Brotli container: one brotli stream, without any signature.
#include <brotli/decode.h>

#include <algorithm>
#include <vector>

#include "trace_container.h"

namespace tilepress {
namespace {

/// Little at first, then twice as much each time, for who wants to see no more than how a file begins: the
/// decoder hands out what it has when its input is used up.
constexpr size_t kFirstInputBytes = 4 << 10, kInputBytes = 64 << 10;
constexpr size_t kOutputBytes = 256 << 10;

class BrotliContainer : public TraceContainer {
 public:
  explicit BrotliContainer(TraceInput& input)
      : input_(input),
        state_(BrotliDecoderCreateInstance(nullptr, nullptr, nullptr), BrotliDecoderDestroyInstance),
        packed_(kFirstInputBytes),
        plain_(kOutputBytes) {}
  const char* name() const override { return "brotli"; }
  bool has_signature() const override { return false; }

  std::span<const uint8_t> next() override {
    if (end() != ContainerEnd::kNotReached) return {};
    if (finished_) return finish(ContainerEnd::kClean, "");
    uint8_t* out = plain_.data();
    size_t room = plain_.size();
    for (;;) {
      const BrotliDecoderResult result =
          BrotliDecoderDecompressStream(state_.get(), &available_, &from_, &room, &out, nullptr);
      if (result == BROTLI_DECODER_RESULT_SUCCESS) finished_ = true;
      if (result == BROTLI_DECODER_RESULT_ERROR) fault_ = ContainerEnd::kCorrupt;
      if (result != BROTLI_DECODER_RESULT_NEEDS_MORE_INPUT || room < plain_.size()) break;
      if (from_ != nullptr) packed_.resize(std::min(2 * packed_.size(), kInputBytes));
      available_ = input_.read(packed_);
      from_ = packed_.data();
      if (available_ == 0) {
        fault_ = ContainerEnd::kTruncated;
        break;
      }
    }
    const size_t length = plain_.size() - room;
    if (length > 0) return {plain_.data(), length};
    if (fault_ == ContainerEnd::kCorrupt) return finish(fault_, "the brotli stream is damaged");
    if (fault_ == ContainerEnd::kTruncated) return finish(fault_, "the brotli stream is cut off");
    return finish(ContainerEnd::kClean, "");
  }

 private:
  TraceInput& input_;
  std::unique_ptr<BrotliDecoderState, decltype(&BrotliDecoderDestroyInstance)> state_;
  std::vector<uint8_t> packed_, plain_;
  const uint8_t* from_ = nullptr;
  size_t available_ = 0;
  bool finished_ = false;
  ContainerEnd fault_ = ContainerEnd::kNotReached;
};

}  // namespace

std::unique_ptr<TraceContainer> open_brotli_container(TraceInput& input) {
  return std::make_unique<BrotliContainer>(input);
}

}  // namespace tilepress
