// Brotli container: one brotli stream without a signature.
#include <brotli/decode.h>

#include <algorithm>
#include <vector>

#include "trace_container.h"
#include "trace_fault.h"

namespace tilepress {
namespace {

/// The first input is small and each one after it twice as large: the decoder returns output when its input
/// is used up, and begins_as_trace() needs only the first bytes.
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
    uint8_t* out = plain_.data();
    size_t room = plain_.size();
    while (!finished_ && !damaged_ && !cut_off_) {
      const BrotliDecoderResult result =
          BrotliDecoderDecompressStream(state_.get(), &available_, &from_, &room, &out, nullptr);
      finished_ = result == BROTLI_DECODER_RESULT_SUCCESS;
      damaged_ = result == BROTLI_DECODER_RESULT_ERROR;
      if (result != BROTLI_DECODER_RESULT_NEEDS_MORE_INPUT || room < plain_.size()) break;
      if (from_ != nullptr) packed_.resize(std::min(2 * packed_.size(), kInputBytes));
      available_ = input_.read(packed_);
      from_ = packed_.data();
      cut_off_ = available_ == 0;
    }
    const size_t length = plain_.size() - room;
    if (length == 0 && damaged_) fail_corrupt("the brotli stream is damaged");
    if (length == 0 && cut_off_) fail_truncated("the brotli stream is cut off");
    return {plain_.data(), length};
  }

 private:
  TraceInput& input_;
  std::unique_ptr<BrotliDecoderState, decltype(&BrotliDecoderDestroyInstance)> state_;
  std::vector<uint8_t> packed_, plain_;
  const uint8_t* from_ = nullptr;
  size_t available_ = 0;
  bool finished_ = false, damaged_ = false, cut_off_ = false;
};

}  // namespace

std::unique_ptr<TraceContainer> open_brotli_container(TraceInput& input) {
  return std::make_unique<BrotliContainer>(input);
}

}  // namespace tilepress
