// Gzip container: what apitrace wrote before it had snappy.
#include <zlib.h>

#include <vector>

#include "trace_container.h"

namespace tilepress {
namespace {

constexpr size_t kInputBytes = 64 << 10;
constexpr size_t kOutputBytes = 256 << 10;
constexpr int kGzipWindowBits = 15 + 16;  // zlib: 16 asks for the gzip wrapper

class GzipContainer : public TraceContainer {
 public:
  explicit GzipContainer(TraceInput& input) : input_(input), packed_(kInputBytes), plain_(kOutputBytes) {
    ready_ = inflateInit2(&stream_, kGzipWindowBits) == Z_OK;
  }
  ~GzipContainer() override {
    if (ready_) inflateEnd(&stream_);
  }
  const char* name() const override { return "gzip"; }

  std::span<const uint8_t> next() override {
    if (end() != ContainerEnd::kNotReached) return {};
    if (!ready_) return finish(ContainerEnd::kCorrupt, "zlib cannot start");
    stream_.next_out = plain_.data();
    stream_.avail_out = static_cast<uInt>(plain_.size());
    while (stream_.avail_out > 0 && fault_ == ContainerEnd::kNotReached && !finished_) {
      if (stream_.avail_in == 0) {
        stream_.avail_in = static_cast<uInt>(input_.read(packed_));
        stream_.next_in = packed_.data();
        if (stream_.avail_in == 0) {
          fault_ = ContainerEnd::kTruncated;
          break;
        }
      }
      const int result = inflate(&stream_, Z_NO_FLUSH);
      if (result == Z_STREAM_END) finished_ = true;
      if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) fault_ = ContainerEnd::kCorrupt;
    }
    const size_t length = plain_.size() - stream_.avail_out;
    if (length > 0) return {plain_.data(), length};
    if (fault_ == ContainerEnd::kCorrupt) return finish(fault_, "the gzip stream is damaged");
    if (fault_ == ContainerEnd::kTruncated) return finish(fault_, "the gzip stream is cut off");
    return finish(ContainerEnd::kClean, "");
  }

 private:
  TraceInput& input_;
  std::vector<uint8_t> packed_, plain_;
  z_stream stream_{};
  bool ready_ = false, finished_ = false;
  ContainerEnd fault_ = ContainerEnd::kNotReached;
};

}  // namespace

std::unique_ptr<TraceContainer> open_gzip_container(TraceInput& input) {
  return std::make_unique<GzipContainer>(input);
}

}  // namespace tilepress
