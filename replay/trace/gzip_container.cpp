// Gzip container: old recordings, from before apitrace used snappy.
#include <zlib.h>

#include <vector>

#include "trace_container.h"
#include "trace_fault.h"

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
    if (!ready_) fail_corrupt("zlib cannot start");
    stream_.next_out = plain_.data();
    stream_.avail_out = static_cast<uInt>(plain_.size());
    while (stream_.avail_out > 0 && !finished_ && !damaged_ && !cut_off_) {
      if (stream_.avail_in == 0) {
        stream_.avail_in = static_cast<uInt>(input_.read(packed_));
        stream_.next_in = packed_.data();
        cut_off_ = stream_.avail_in == 0;
        if (cut_off_) break;
      }
      const int result = inflate(&stream_, Z_NO_FLUSH);
      finished_ = result == Z_STREAM_END;
      damaged_ = result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR;
    }
    const size_t length = plain_.size() - stream_.avail_out;
    if (length == 0 && damaged_) fail_corrupt("the gzip stream is damaged");
    if (length == 0 && cut_off_) fail_truncated("the gzip stream is cut off");
    return {plain_.data(), length};
  }

 private:
  TraceInput& input_;
  std::vector<uint8_t> packed_, plain_;
  z_stream stream_{};
  bool ready_ = false, finished_ = false, damaged_ = false, cut_off_ = false;
};

}  // namespace

std::unique_ptr<TraceContainer> open_gzip_container(TraceInput& input) {
  return std::make_unique<GzipContainer>(input);
}

}  // namespace tilepress
