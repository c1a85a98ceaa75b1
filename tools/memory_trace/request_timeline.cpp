// Request timeline: few streams are open at a time, so that the next one is found by looking at all.
#include "memory_trace/request_timeline.h"

#include <algorithm>

#include "memory_trace/frame_accesses.h"

namespace tilepress {

/// Walks over the requests of one stream.
class RequestTimeline::Stream {
 public:
  Stream(AccessStream accesses, const RequestShape& shape) : all_(std::move(accesses)), shape_(shape) {
    request_.write = all_.write;
    request_.surface = all_.surface;
    request_.frame = all_.frame;
    request_.bytes = shape.request_bytes;
    if (all_.stored) content_.resize(shape.request_bytes);
    count_ = count();
    if (count_ == 0) return;
    const uint64_t length = all_.end_ps - all_.begin_ps;
    step_ = length / count_;
    remainder_ = length % count_;
    request_.time_ps = all_.begin_ps;
    enter_access();
  }

  bool ended() const { return count_ == 0; }
  uint64_t time_ps() const { return request_.time_ps; }

  const MemoryRequest& request() {
    request_.address = piece_ * shape_.request_bytes;
    request_.part = all_.accesses[access_].part;
    if (all_.stored) fill_content();
    return request_;
  }

  void next() {
    if (--count_ == 0) return;
    request_.time_ps += step_;
    rest_ += remainder_;
    if (rest_ >= total_) {
      rest_ -= total_;
      ++request_.time_ps;
    }
    if (piece_ < last_piece_)
      ++piece_;
    else
      enter_access();
  }

 private:
  struct Pieces {
    uint64_t first, last;
  };
  Pieces pieces_of(const MemoryFetch& access) const {
    const uint64_t address = all_.place.of(access.part) + access.offset_bytes;
    return {address / shape_.request_bytes,
            (address + access.bursts * shape_.burst_bytes - 1) / shape_.request_bytes};
  }
  /// Whether the access begins in the piece where the one before it ended.
  bool continues(size_t access, const Pieces& pieces) const {
    return access > 0 && all_.accesses[access - 1].part == all_.accesses[access].part &&
           pieces_of(all_.accesses[access - 1]).last == pieces.first;
  }

  uint64_t count() {
    uint64_t sum = 0;
    for (size_t i = 0; i < all_.accesses.size(); ++i) {
      const Pieces pieces = pieces_of(all_.accesses[i]);
      sum += pieces.last - pieces.first + (continues(i, pieces) ? 0 : 1);
    }
    return total_ = sum;
  }

  /// Goes to the next access that has a piece of its own.
  void enter_access() {
    for (;;) {
      access_ = begun_ ? access_ + 1 : 0;
      begun_ = true;
      const Pieces pieces = pieces_of(all_.accesses[access_]);
      piece_ = pieces.first + (continues(access_, pieces) ? 1 : 0);
      last_piece_ = pieces.last;
      if (piece_ <= last_piece_) return;
    }
  }

  /// The bytes of the piece that belong to the part; the others are zero.
  void fill_content() {
    const uint64_t part_begin = all_.place.of(request_.part);
    const uint64_t skipped = request_.address < part_begin ? part_begin - request_.address : 0;
    std::fill_n(content_.begin(), skipped, uint8_t{0});
    copy_part(*all_.stored, request_.part, request_.address + skipped - part_begin,
              std::span(content_).subspan(skipped));
    request_.content = content_;
  }

  const AccessStream all_;
  const RequestShape shape_;
  MemoryRequest request_;
  std::vector<uint8_t> content_;
  uint64_t count_ = 0, total_ = 0;  ///< requests left, and in all
  uint64_t step_ = 0, remainder_ = 0, rest_ = 0;
  size_t access_ = 0;
  bool begun_ = false;
  uint64_t piece_ = 0, last_piece_ = 0;  ///< numbers of aligned pieces of request_bytes
};

RequestTimeline::RequestTimeline(const RequestShape& shape, RequestSink& sink) : shape_(shape), sink_(sink) {}
RequestTimeline::~RequestTimeline() = default;

void RequestTimeline::add(AccessStream stream) {
  auto added = std::make_unique<Stream>(std::move(stream), shape_);
  if (!added->ended()) streams_.push_back(std::move(added));
}

Result<void> RequestTimeline::advance_to(uint64_t time_ps) {
  while (!streams_.empty()) {
    const auto next = std::ranges::min_element(
        streams_, {}, [](const std::unique_ptr<Stream>& stream) { return stream->time_ps(); });
    Stream& stream = **next;
    if (stream.time_ps() >= time_ps) return {};
    if (const auto taken = sink_.take(stream.request()); !taken) return taken;
    stream.next();
    if (stream.ended()) streams_.erase(next);
  }
  return {};
}

}  // namespace tilepress
