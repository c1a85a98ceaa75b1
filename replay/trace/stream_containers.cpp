// Stream containers: files that are one compressed stream. Brotli has no signature; gzip is what apitrace
// wrote before it used snappy.
#include <brotli/decode.h>
#include <zlib.h>

#include <algorithm>
#include <vector>

#include "trace_container.h"

namespace tilepress {
namespace {

/// The first input is small and each one after it twice as large, because begins_as_trace() needs only the
/// first bytes.
constexpr size_t kFirstInputBytes = 4 << 10, kInputBytes = 64 << 10;
constexpr size_t kOutputBytes = 256 << 10;

class StreamContainer : public TraceContainer {
 public:
  explicit StreamContainer(TraceInput& input)
      : input_(input), packed_(kFirstInputBytes), plain_(kOutputBytes) {}

  std::span<const uint8_t> next() override {
    size_t length = 0;
    while (length == 0 && (state_ == State::kNeedsInput || state_ == State::kHasOutput)) {
      if (state_ == State::kNeedsInput) refill();
      if (state_ != State::kCutOff) state_ = decode(unread_, plain_, length);
    }
    if (length == 0 && state_ == State::kDamaged)
      fail_corrupt(std::string("the ") + name() + " stream is damaged");
    if (length == 0 && state_ == State::kCutOff)
      fail_truncated(std::string("the ") + name() + " stream is cut off");
    return {plain_.data(), length};
  }

 protected:
  enum class State { kNeedsInput, kHasOutput, kFinished, kDamaged, kCutOff };
  /// Takes bytes from the front of `packed`, writes to the front of `plain`, and sets `length` to the bytes
  /// written.
  virtual State decode(std::span<const uint8_t>& packed, std::span<uint8_t> plain, size_t& length) = 0;

 private:
  void refill() {
    if (unread_.data() != nullptr) packed_.resize(std::min(2 * packed_.size(), kInputBytes));
    unread_ = std::span(packed_).first(input_.read(packed_));
    if (unread_.empty()) state_ = State::kCutOff;
  }

  TraceInput& input_;
  std::vector<uint8_t> packed_, plain_;
  std::span<const uint8_t> unread_;
  State state_ = State::kNeedsInput;
};

class BrotliContainer : public StreamContainer {
 public:
  using StreamContainer::StreamContainer;
  const char* name() const override { return "brotli"; }
  bool has_signature() const override { return false; }

 private:
  State decode(std::span<const uint8_t>& packed, std::span<uint8_t> plain, size_t& length) override {
    size_t available = packed.size(), room = plain.size();
    const uint8_t* from = packed.data();
    uint8_t* to = plain.data();
    const auto result = BrotliDecoderDecompressStream(state_.get(), &available, &from, &room, &to, nullptr);
    packed = packed.last(available);
    length = plain.size() - room;
    if (result == BROTLI_DECODER_RESULT_SUCCESS) return State::kFinished;
    if (result == BROTLI_DECODER_RESULT_ERROR) return State::kDamaged;
    return result == BROTLI_DECODER_RESULT_NEEDS_MORE_INPUT ? State::kNeedsInput : State::kHasOutput;
  }

  std::unique_ptr<BrotliDecoderState, decltype(&BrotliDecoderDestroyInstance)> state_{
      BrotliDecoderCreateInstance(nullptr, nullptr, nullptr), BrotliDecoderDestroyInstance};
};

class GzipContainer : public StreamContainer {
 public:
  explicit GzipContainer(TraceInput& input) : StreamContainer(input) {
    constexpr int kGzipWindowBits = 15 + 16;  // zlib: 16 stands for the gzip wrapper
    ready_ = inflateInit2(&stream_, kGzipWindowBits) == Z_OK;
  }
  ~GzipContainer() override {
    if (ready_) inflateEnd(&stream_);
  }
  const char* name() const override { return "gzip"; }

 private:
  State decode(std::span<const uint8_t>& packed, std::span<uint8_t> plain, size_t& length) override {
    if (!ready_) return State::kDamaged;
    stream_.next_in = const_cast<Bytef*>(packed.data());  // zlib only reads
    stream_.avail_in = static_cast<uInt>(packed.size());
    stream_.next_out = plain.data();
    stream_.avail_out = static_cast<uInt>(plain.size());
    const int result = inflate(&stream_, Z_NO_FLUSH);
    packed = packed.last(stream_.avail_in);
    length = plain.size() - stream_.avail_out;
    if (result == Z_STREAM_END) return State::kFinished;
    if (result != Z_OK && result != Z_BUF_ERROR) return State::kDamaged;
    return stream_.avail_out == 0 ? State::kHasOutput : State::kNeedsInput;
  }

  z_stream stream_{};
  bool ready_ = false;
};

}  // namespace

std::unique_ptr<TraceContainer> open_brotli_container(TraceInput& input) {
  return std::make_unique<BrotliContainer>(input);
}

std::unique_ptr<TraceContainer> open_gzip_container(TraceInput& input) {
  return std::make_unique<GzipContainer>(input);
}

}  // namespace tilepress
