// A stream of packets through the SimObject of gem5.md, on stubs of gem5: what reaches DRAM is what the
// engine counts, in atomic and in timing mode, and a display reads back every pixel. The same frames pass
// Emerald's way. Exit status 0 if so.
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <vector>

#include "emerald_frames.h"
#include "surface_compressor.hh"
#include "tilepress/surface_engine.h"

namespace {

constexpr uint32_t kWidth = 100, kHeight = 60, kLine = 64, kBurst = 16;
constexpr uint64_t kFrameBytes = uint64_t{kWidth} * kHeight * 4, kBase = 0x80000000, kFrameEnd = 0x90000000;

std::vector<uint8_t> draw(uint32_t frame) {
  std::vector<uint8_t> bytes(kFrameBytes);
  for (uint64_t i = 0; i < kFrameBytes / 4; ++i) {
    const auto x = static_cast<uint32_t>(i % kWidth), y = static_cast<uint32_t>(i / kWidth);
    const uint32_t noise = (x * 2654435761u ^ y * 40503u ^ frame * 97u) >> 24;
    const uint32_t pixel = x / 20 == 2  ? noise << 8
                           : y % 13 < 9 ? 0xFF204060
                                        : 0xFF000000 | (x / 7 + frame) * 0x010203;
    std::memcpy(&bytes[4 * i], &pixel, 4);
  }
  return bytes;
}

/// DRAM that counts bursts and keeps what is written.
class Dram : public gem5::ResponsePort {
 public:
  Dram() : ResponsePort("dram") {}
  gem5::AddrRangeList getAddrRanges() const override { return {gem5::AddrRange(0, UINT64_MAX)}; }
  gem5::Tick recvAtomic(gem5::PacketPtr pkt) override {
    recvFunctional(pkt);
    return 1;
  }
  void recvFunctional(gem5::PacketPtr pkt) override {
    pkt->isRead() ? ++reads : ++writes;
    if (pkt->isWrite())
      held[pkt->getAddr()] = std::vector<uint8_t>(pkt->bytes(), pkt->bytes() + pkt->getSize());
    if (pkt->isRead() && !held.contains(pkt->getAddr())) ++unknown;
    if (pkt->needsResponse()) pkt->makeResponse();
  }
  bool recvTimingReq(gem5::PacketPtr pkt) override {
    recvFunctional(pkt);
    return sendTimingResp(pkt);
  }
  uint64_t reads = 0, writes = 0, unknown = 0;  ///< unknown: bursts read that no one wrote
  std::map<uint64_t, std::vector<uint8_t>> held;
};

/// GPU and display in one.
class Gpu : public gem5::RequestPort {
 public:
  explicit Gpu(bool timing) : RequestPort("gpu"), timing_(timing) {}
  bool recvTimingResp(gem5::PacketPtr pkt) override {
    answered_ = pkt;
    return true;
  }
  void write(uint64_t addr, const uint8_t* bytes, uint32_t size) {
    auto pkt = packet(addr, size, gem5::MemCmd::WriteReq);
    pkt->setData(bytes);
    send(*pkt);
  }
  std::vector<uint8_t> read(uint64_t addr, uint32_t size) {
    auto pkt = packet(addr, size, gem5::MemCmd::ReadReq);
    send(*pkt);
    return std::vector<uint8_t>(pkt->bytes(), pkt->bytes() + size);
  }
  uint64_t lost = 0;

 private:
  static std::unique_ptr<gem5::Packet> packet(uint64_t addr, uint32_t size, gem5::MemCmd::Command command) {
    auto pkt = std::make_unique<gem5::Packet>(std::make_shared<gem5::Request>(addr, size, 0, 0), command);
    pkt->allocate();
    return pkt;
  }
  void send(gem5::Packet& pkt) {
    answered_ = nullptr;
    timing_ ? void(sendTimingReq(&pkt)) : void(sendAtomic(&pkt));
    if (!pkt.isResponse() || (timing_ && answered_ != &pkt)) ++lost;
  }
  const bool timing_;
  gem5::PacketPtr answered_ = nullptr;
};

bool equal(const char* what, uint64_t found, uint64_t expected) {
  if (found == expected) return true;
  std::fprintf(stderr, "gem5_stream: %s: %llu, expected %llu\n", what, static_cast<unsigned long long>(found),
               static_cast<unsigned long long>(expected));
  return false;
}

uint64_t bursts_of(const tilepress::SchemeStatistics& frame) {
  const auto whole = [&](uint64_t bits) { return (bits + frame.burst_bits - 1) / frame.burst_bits; };
  return frame.bursts + whole(frame.csb_bits) + whole(frame.palette_bits);
}

bool pass_gem5(const std::string& scheme, bool timing) {
  gem5::System system(timing);
  gem5::SurfaceCompressorParams params{{"compressor"}, gem5::AddrRange(kBase, kBase + 0x100000),
                                       kFrameEnd,      kWidth,
                                       kHeight,        32,
                                       kBurst,         scheme,
                                       &system};
  gem5::SurfaceCompressor compressor(params);
  Gpu gpu(timing);
  Dram dram;
  gpu.bind(compressor.getPort("cpu_side"));
  compressor.getPort("mem_side").bind(dram);
  tilepress::SurfaceEngine engine({*tilepress::parse_scheme(scheme)}, tilepress::ModelOptions{});
  tilepress::FrameStatistics expected;
  for (uint32_t number = 0; number < 4; ++number) {
    const std::vector<uint8_t> frame = draw(number);
    engine.process({reinterpret_cast<const std::byte*>(frame.data()), kWidth * 4, kWidth, kHeight}, expected);
    dram.reads = dram.writes = 0;
    dram.held.clear();
    for (uint64_t at = 0; at < kFrameBytes; at += kLine)  // lines arrive in no order
      gpu.write(kBase + at * 37 % kFrameBytes, &frame[at * 37 % kFrameBytes], kLine);
    const uint8_t bell = 1;
    gpu.write(kFrameEnd, &bell, 1);
    for (uint64_t at = 0; at < kFrameBytes; at += kLine)
      if (gpu.read(kBase + at, kLine) != std::vector<uint8_t>(&frame[at], &frame[at] + kLine))
        return equal("a line", at, 0);
    const uint64_t bursts = bursts_of(expected.schemes.front());
    if (!equal("bursts written", dram.writes, bursts) || !equal("bursts read", dram.reads, bursts) ||
        !equal("bursts read that no one wrote", dram.unknown, 0) || !equal("packets lost", gpu.lost, 0))
      return false;
    if (timing)
      std::printf("%s, frame %u: %llu bursts of %llu\n", scheme.c_str(), number,
                  static_cast<unsigned long long>(bursts),
                  static_cast<unsigned long long>(expected.schemes.front().raw_bits / (8 * kBurst)));
  }
  gpu.write(0x1000, draw(0).data(), kLine);  // other memory passes
  return equal("packets outside", dram.held.count(0x1000), 1);
}

bool pass_emerald(const std::string& scheme) {
  EmeraldFrames frames(scheme, kWidth, kHeight);
  tilepress::SurfaceEngine engine({*tilepress::parse_scheme(scheme)}, tilepress::ModelOptions{});
  tilepress::FrameStatistics expected;
  uint64_t written = 0;
  for (uint32_t number = 0; number < 3; ++number) {
    const std::vector<uint8_t> frame = draw(number);
    engine.process({reinterpret_cast<const std::byte*>(frame.data()), kWidth * 4, kWidth, kHeight}, expected);
    written += bursts_of(expected.schemes.front());
    std::vector<uint8_t> bottom_up;
    for (uint32_t y = kHeight; y-- > 0;)
      bottom_up.insert(bottom_up.end(), &frame[size_t{y} * kWidth * 4],
                       &frame[size_t{y} * kWidth * 4] + kWidth * 4);
    frames.endOfFrame(bottom_up.data());
  }
  return equal("Emerald's bursts", frames.bursts(), written);
}

}  // namespace

int main() {
  bool good = true;
  for (const char* scheme : {"vdcp", "hdcp:fvc=16", "ras"}) {
    for (const bool timing : {false, true}) good = good && pass_gem5(scheme, timing);
    good = good && pass_emerald(scheme);
  }
  return good ? 0 : 1;
}
