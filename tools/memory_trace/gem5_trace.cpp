// gem5 trace: packets in protobuf's wire format.
#include <google/protobuf/io/coded_stream.h>

#include "gem5_packet.pb.h"
#include "memory_trace/trace_formats.h"

namespace tilepress {
namespace {

class Gem5Formatter : public TraceFormatter {
 public:
  void begin(std::string& out) override {
    constexpr uint64_t kTicksPerSecond = 1'000'000'000'000;
    out += "gem5";
    gem5::PacketHeader header;
    header.set_obj_id("tilepress");
    header.set_tick_freq(kTicksPerSecond);
    append_message(header, out);
  }

  void append(const MemoryRequest& request, std::string& out) override {
    constexpr uint32_t kReadRequest = 1, kWriteRequest = 4;
    packet_.set_tick(request.time_ps);
    packet_.set_cmd(request.write ? kWriteRequest : kReadRequest);
    packet_.set_addr(request.address);
    packet_.set_size(request.bytes);
    packet_.set_pkt_id(request.frame);
    append_message(packet_, out);
  }

 private:
  template <class Message>
  static void append_message(const Message& message, std::string& out) {
    constexpr size_t kLongestVarint = 10;
    using google::protobuf::io::CodedOutputStream;
    const size_t size = message.ByteSizeLong(), before = out.size();
    out.resize(before + kLongestVarint + size);
    auto* at = reinterpret_cast<uint8_t*>(out.data() + before);
    at = CodedOutputStream::WriteVarint32ToArray(static_cast<uint32_t>(size), at);
    at = message.SerializeWithCachedSizesToArray(at);
    out.resize(static_cast<size_t>(at - reinterpret_cast<uint8_t*>(out.data())));
  }

  gem5::Packet packet_;
};

}  // namespace

std::unique_ptr<TraceFormatter> make_gem5_formatter() {
  return std::make_unique<Gem5Formatter>();
}

}  // namespace tilepress
