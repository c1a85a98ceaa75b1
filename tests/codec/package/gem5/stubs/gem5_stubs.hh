// STUBS, not gem5: the few names of gem5 that surface_compressor.* uses, so that it compiles and runs without gem5. Time
// stands still: a scheduled packet arrives at once, and no one refuses a packet.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gem5
{

using Addr = uint64_t;
using Tick = uint64_t;
using PortID = int16_t;
using RequestorID = uint16_t;
constexpr PortID InvalidPortID = -1;

struct Cycles
{
    explicit Cycles(uint64_t) {}
};

class AddrRange
{
  public:
    AddrRange(Addr start, Addr end) : first(start), last(end) {}
    Addr start() const { return first; }
    Addr size() const { return last - first; }

  private:
    Addr first, last;
};
using AddrRangeList = std::list<AddrRange>;

struct Request
{
    Request(Addr addr, unsigned size, uint64_t, RequestorID) : addr(addr), size(size) {}
    Addr addr;
    unsigned size;
};
using RequestPtr = std::shared_ptr<Request>;

struct MemCmd
{
    enum Command { ReadReq, WriteReq, WritebackDirty };
};

class Packet
{
  public:
    struct SenderState
    {
        virtual ~SenderState() = default;
        SenderState *predecessor = nullptr;
    };
    Packet(const RequestPtr &request, MemCmd::Command command) : request(request), command(command) {}
    Addr getAddr() const { return request->addr; }
    unsigned getSize() const { return request->size; }
    bool isRead() const { return command == MemCmd::ReadReq; }
    bool isWrite() const { return !isRead(); }
    bool isResponse() const { return response; }
    bool needsResponse() const { return command != MemCmd::WritebackDirty && !response; }
    void makeResponse() { response = true; }
    void makeTimingResponse() { makeResponse(); }
    void makeAtomicResponse() { makeResponse(); }
    void allocate() { data.resize(getSize()); }
    void setData(const uint8_t *from) { std::memcpy(data.data(), from, getSize()); }
    void writeData(uint8_t *to) const { std::memcpy(to, data.data(), getSize()); }
    const uint8_t *bytes() const { return data.data(); }
    void pushSenderState(SenderState *state)
    {
        state->predecessor = senderState;
        senderState = state;
    }
    SenderState *popSenderState()
    {
        SenderState *state = senderState;
        senderState = state->predecessor;
        return state;
    }
    SenderState *senderState = nullptr;

  private:
    RequestPtr request;
    MemCmd::Command command;
    bool response = false;
    std::vector<uint8_t> data;
};
using PacketPtr = Packet *;

class Port
{
  public:
    explicit Port(std::string name) : portName(std::move(name)) {}
    virtual ~Port() = default;
    void bind(Port &other) { peer = &other, other.peer = this; }

  protected:
    Port *peer = nullptr;

  private:
    std::string portName;
};

class RequestPort;

class ResponsePort : public Port
{
  public:
    using Port::Port;
    virtual AddrRangeList getAddrRanges() const = 0;
    virtual Tick recvAtomic(PacketPtr pkt) = 0;
    virtual void recvFunctional(PacketPtr pkt) = 0;
    virtual bool recvTimingReq(PacketPtr pkt) = 0;
    bool sendTimingResp(PacketPtr pkt);
    void sendRangeChange() const {}
};

class RequestPort : public Port
{
  public:
    using Port::Port;
    virtual bool recvTimingResp(PacketPtr pkt) = 0;
    virtual void recvRangeChange() {}
    Tick sendAtomic(PacketPtr pkt) { return responder().recvAtomic(pkt); }
    void sendFunctional(PacketPtr pkt) { responder().recvFunctional(pkt); }
    bool sendTimingReq(PacketPtr pkt) { return responder().recvTimingReq(pkt); }
    AddrRangeList getAddrRanges() const { return responder().getAddrRanges(); }

  private:
    ResponsePort &responder() const { return static_cast<ResponsePort &>(*peer); }
};

inline bool
ResponsePort::sendTimingResp(PacketPtr pkt)
{
    return static_cast<RequestPort &>(*peer).recvTimingResp(pkt);
}

struct SimObject
{};

struct RespPacketQueue
{
    RespPacketQueue(SimObject &, ResponsePort &) {}
};
struct ReqPacketQueue
{
    ReqPacketQueue(SimObject &, RequestPort &) {}
};
struct SnoopRespPacketQueue
{
    SnoopRespPacketQueue(SimObject &, RequestPort &) {}
};

class QueuedResponsePort : public ResponsePort
{
  public:
    QueuedResponsePort(const std::string &name, RespPacketQueue &) : ResponsePort(name) {}
    void schedTimingResp(PacketPtr pkt, Tick) { sendTimingResp(pkt); }
};

class QueuedRequestPort : public RequestPort
{
  public:
    QueuedRequestPort(const std::string &name, ReqPacketQueue &, SnoopRespPacketQueue &) : RequestPort(name) {}
    void schedTimingReq(PacketPtr pkt, Tick) { sendTimingReq(pkt); }
};

struct System
{
    explicit System(bool timing) : timing(timing) {}
    bool isTimingMode() const { return timing; }
    RequestorID getRequestorId(const SimObject *) { return 1; }
    bool timing;
};

namespace statistics
{
struct Group
{
    explicit Group(Group *) {}
};
struct Scalar
{
    Scalar(Group *, const char *) {}
    void operator++() { ++value; }
    void operator+=(double by) { value += by; }
    double value = 0;
};
} // namespace statistics
#define ADD_STAT(name, unit, description) name(this, description)

struct ClockedObjectParams
{
    std::string name;
};

class ClockedObject : public SimObject, public statistics::Group
{
  public:
    explicit ClockedObject(const ClockedObjectParams &) : Group(nullptr) {}
    virtual ~ClockedObject() = default;
    virtual Port &getPort(const std::string &, PortID = InvalidPortID) { std::abort(); }
    Tick clockEdge(Cycles = Cycles(0)) const { return 0; }
};

// gem5 makes this struct from SurfaceCompressor.py.
struct SurfaceCompressorParams : public ClockedObjectParams
{
    AddrRange range;
    Addr frame_end;
    unsigned width, height, tile, burst_bytes;
    std::string scheme;
    System *system;
};

} // namespace gem5

#define fatal_if(condition, ...) \
    do { \
        if (condition) \
            std::abort(); \
    } while (false)
