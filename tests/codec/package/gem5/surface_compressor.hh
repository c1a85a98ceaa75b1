// gem5 SimObject between a GPU, or the last cache, and the DRAM controller: framebuffer writes go in raw, compressed bursts
// come out. Copy surface_compressor.* and compressed_framebuffer.* to src/mem of gem5 (codec/gem5.md). C++17, as gem5 is.
#ifndef __MEM_SURFACE_COMPRESSOR_HH__
#define __MEM_SURFACE_COMPRESSOR_HH__

#include <memory>
#include <string>

#include "base/statistics.hh"
#include "compressed_framebuffer.h"
#include "mem/qport.hh"
#include "params/SurfaceCompressor.hh"
#include "sim/clocked_object.hh"
#include "sim/system.hh"

namespace gem5
{

class SurfaceCompressor : public ClockedObject
{
  public:
    explicit SurfaceCompressor(const SurfaceCompressorParams &params);

    Port &getPort(const std::string &name, PortID index = InvalidPortID) override;

    /** The frame is complete: compresses it and sends its bursts. A write to the address frame_end calls it too. */
    void endFrame();

  private:
    class CpuSidePort : public QueuedResponsePort
    {
      public:
        CpuSidePort(const std::string &name, SurfaceCompressor &owner)
            : QueuedResponsePort(name, queue), owner(owner), queue(owner, *this)
        {}
        AddrRangeList getAddrRanges() const override { return owner.memSide.getAddrRanges(); }

      protected:
        Tick recvAtomic(PacketPtr pkt) override { return owner.takeAtomic(pkt); }
        void recvFunctional(PacketPtr pkt) override { owner.takeFunctional(pkt); }
        bool recvTimingReq(PacketPtr pkt) override { return owner.takeRequest(pkt); }

      private:
        SurfaceCompressor &owner;
        RespPacketQueue queue;
    };

    class MemSidePort : public QueuedRequestPort
    {
      public:
        MemSidePort(const std::string &name, SurfaceCompressor &owner)
            : QueuedRequestPort(name, queue, snoopQueue), owner(owner), queue(owner, *this), snoopQueue(owner, *this)
        {}

      protected:
        bool recvTimingResp(PacketPtr pkt) override { return owner.takeResponse(pkt); }
        void recvRangeChange() override { owner.cpuSide.sendRangeChange(); }

      private:
        SurfaceCompressor &owner;
        ReqPacketQueue queue;
        SnoopRespPacketQueue snoopQueue;
    };

    /** A request that waits for bursts; a write waits for none. */
    struct Waiting
    {
        PacketPtr pkt;
        unsigned bursts;
    };
    /** Marks the packets that this object made. `waiting` is null for writes. */
    struct OwnPacket : public Packet::SenderState
    {
        explicit OwnPacket(Waiting *waiting) : waiting(waiting) {}
        Waiting *waiting;
    };
    struct Stats : public statistics::Group
    {
        explicit Stats(statistics::Group *parent);
        statistics::Scalar frames, rawBursts, writeBursts, readBursts;
    };

    bool inFramebuffer(PacketPtr pkt) const;
    bool endsFrame(PacketPtr pkt) const;
    PacketPtr makeWrite(Addr addr, const uint8_t *bytes) const;
    PacketPtr makeRead(Addr addr) const;
    void write(PacketPtr pkt);
    void read(PacketPtr pkt, const simulator::CompressedFramebuffer::Fetch &fetch);
    Tick takeAtomic(PacketPtr pkt);
    void takeFunctional(PacketPtr pkt);
    bool takeRequest(PacketPtr pkt);
    bool takeResponse(PacketPtr pkt);
    void finish(Waiting *waiting);

    const AddrRange range;
    const Addr frameEnd;
    const RequestorID requestorId;
    System *const system;
    const unsigned burstBytes;
    simulator::CompressedFramebuffer framebuffer;
    CpuSidePort cpuSide;
    MemSidePort memSide;
    Stats stats;
    std::unique_ptr<Packet> doomed;  // the sender may still look at a packet that needs no response
};

} // namespace gem5

#endif // __MEM_SURFACE_COMPRESSOR_HH__
