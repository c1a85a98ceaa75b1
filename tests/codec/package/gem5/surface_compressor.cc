// gem5 SimObject: see surface_compressor.hh.
#include "surface_compressor.hh"

#include <vector>

#include "base/logging.hh"

namespace gem5
{
namespace
{

simulator::FramebufferSettings
settingsOf(const SurfaceCompressorParams &params)
{
    simulator::FramebufferSettings settings;
    settings.scheme = params.scheme;
    settings.width = params.width;
    settings.height = params.height;
    settings.tile = params.tile;
    settings.burst_bytes = params.burst_bytes;
    settings.dram_base = params.range.start();
    return settings;
}

} // namespace

SurfaceCompressor::Stats::Stats(statistics::Group *parent)
    : statistics::Group(parent),
      ADD_STAT(frames, statistics::units::Count::get(), "frames that ended"),
      ADD_STAT(rawBursts, statistics::units::Count::get(), "bursts of the frames without compression"),
      ADD_STAT(writeBursts, statistics::units::Count::get(), "bursts written: payload, CSB and tables"),
      ADD_STAT(readBursts, statistics::units::Count::get(), "bursts read: payload, CSB and tables")
{}

SurfaceCompressor::SurfaceCompressor(const SurfaceCompressorParams &params)
    : ClockedObject(params),
      range(params.range),
      frameEnd(params.frame_end),
      requestorId(params.system->getRequestorId(this)),
      system(params.system),
      burstBytes(params.burst_bytes),
      framebuffer(settingsOf(params)),
      cpuSide(params.name + ".cpu_side", *this),
      memSide(params.name + ".mem_side", *this),
      stats(this)
{
    fatal_if(!framebuffer.error().empty(), "SurfaceCompressor: %s", framebuffer.error());
    fatal_if(range.size() < framebuffer.dram_bytes(), "SurfaceCompressor: the range needs %d bytes",
             framebuffer.dram_bytes());
}

Port &
SurfaceCompressor::getPort(const std::string &name, PortID index)
{
    if (name == "cpu_side")
        return cpuSide;
    if (name == "mem_side")
        return memSide;
    return ClockedObject::getPort(name, index);
}

bool
SurfaceCompressor::inFramebuffer(PacketPtr pkt) const
{
    return pkt->getAddr() >= range.start() && pkt->getAddr() + pkt->getSize() <= range.start() + framebuffer.bytes();
}

bool
SurfaceCompressor::endsFrame(PacketPtr pkt) const
{
    return pkt->isWrite() && pkt->getAddr() == frameEnd;
}

PacketPtr
SurfaceCompressor::makeRead(Addr addr) const
{
    auto request = std::make_shared<Request>(addr, burstBytes, 0, requestorId);
    PacketPtr pkt = new Packet(request, MemCmd::ReadReq);
    pkt->allocate();
    return pkt;
}

PacketPtr
SurfaceCompressor::makeWrite(Addr addr, const uint8_t *bytes) const
{
    auto request = std::make_shared<Request>(addr, burstBytes, 0, requestorId);
    PacketPtr pkt = new Packet(request, MemCmd::WriteReq);
    pkt->allocate();
    pkt->setData(bytes);
    return pkt;
}

void
SurfaceCompressor::endFrame()
{
    framebuffer.end_frame([this](Addr addr, const uint8_t *bytes) {
        PacketPtr pkt = makeWrite(addr, bytes);
        ++stats.writeBursts;
        if (system->isTimingMode()) {
            pkt->pushSenderState(new OwnPacket(nullptr));
            memSide.schedTimingReq(pkt, clockEdge());
        } else {
            memSide.sendAtomic(pkt);
            delete pkt;
        }
    });
    ++stats.frames;
    stats.rawBursts += framebuffer.raw_bursts();
}

void
SurfaceCompressor::write(PacketPtr pkt)
{
    pkt->writeData(framebuffer.drawn() + (pkt->getAddr() - range.start()));
}

void
SurfaceCompressor::read(PacketPtr pkt, const simulator::CompressedFramebuffer::Fetch &fetch)
{
    std::vector<uint8_t> bytes(pkt->getSize());
    const bool decoded = framebuffer.read(pkt->getAddr() - range.start(), bytes.data(), bytes.size(), [&](Addr addr) {
        ++stats.readBursts;
        fetch(addr);
    });
    fatal_if(!decoded, "SurfaceCompressor: read before the first frame ended");
    pkt->setData(bytes.data());
}

Tick
SurfaceCompressor::takeAtomic(PacketPtr pkt)
{
    if (!inFramebuffer(pkt) && !endsFrame(pkt))
        return memSide.sendAtomic(pkt);
    Tick latency = 0;
    if (endsFrame(pkt)) {
        endFrame();
    } else if (pkt->isWrite()) {
        write(pkt);
    } else {
        read(pkt, [&](Addr addr) {
            PacketPtr fetch = makeRead(addr);
            latency += memSide.sendAtomic(fetch);
            delete fetch;
        });
    }
    if (pkt->needsResponse())
        pkt->makeAtomicResponse();
    return latency;
}

void
SurfaceCompressor::takeFunctional(PacketPtr pkt)
{
    if (!inFramebuffer(pkt)) {
        memSide.sendFunctional(pkt);
        return;
    }
    // Functional accesses are not traffic: they see the raw frame.
    if (pkt->isWrite())
        write(pkt);
    else
        pkt->setData(framebuffer.drawn() + (pkt->getAddr() - range.start()));
    if (pkt->needsResponse())
        pkt->makeResponse();
}

bool
SurfaceCompressor::takeRequest(PacketPtr pkt)
{
    if (!inFramebuffer(pkt) && !endsFrame(pkt)) {
        memSide.schedTimingReq(pkt, clockEdge());
        return true;
    }
    auto *waiting = new Waiting{pkt, 1};  // one more than the bursts, until all are on their way
    if (endsFrame(pkt)) {
        endFrame();
    } else if (pkt->isWrite()) {
        write(pkt);
    } else {
        read(pkt, [&](Addr addr) {
            PacketPtr fetch = makeRead(addr);
            fetch->pushSenderState(new OwnPacket(waiting));
            ++waiting->bursts;
            memSide.schedTimingReq(fetch, clockEdge());
        });
    }
    finish(waiting);
    return true;
}

void
SurfaceCompressor::finish(Waiting *waiting)
{
    if (--waiting->bursts > 0)
        return;
    PacketPtr pkt = waiting->pkt;
    delete waiting;
    if (!pkt->needsResponse()) {
        doomed.reset(pkt);
        return;
    }
    pkt->makeTimingResponse();
    cpuSide.schedTimingResp(pkt, clockEdge(Cycles(1)));
}

bool
SurfaceCompressor::takeResponse(PacketPtr pkt)
{
    auto *own = dynamic_cast<OwnPacket *>(pkt->senderState);
    if (own == nullptr) {
        cpuSide.schedTimingResp(pkt, clockEdge());
        return true;
    }
    pkt->popSenderState();
    if (own->waiting != nullptr)
        finish(own->waiting);
    delete own;
    delete pkt;
    return true;
}

} // namespace gem5
