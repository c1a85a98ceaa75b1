// Trace formats: the formats of one line per request.
#include "memory_trace/trace_formats.h"

#include <bit>
#include <charconv>
#include <string_view>

namespace tilepress {
namespace {

void append_decimal(std::string& out, uint64_t value) {
  char digits[20];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_hex(std::string& out, uint64_t value) {
  char digits[16];
  out += "0x";
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value, 16).ptr);
}

std::string_view name_of(SurfacePart part) {
  return part == SurfacePart::kPayload ? "payload" : part == SurfacePart::kCsb ? "csb" : "tables";
}

/// time_ps,frame,surface,operation,part,address,bytes[,data]
class CsvFormatter : public TraceFormatter {
 public:
  explicit CsvFormatter(bool content) : content_(content) {}
  void begin(std::string& out) override {
    out += "time_ps,frame,surface,operation,part,address,bytes";
    out += content_ ? ",data\n" : "\n";
  }
  void append(const MemoryRequest& request, std::string& out) override {
    append_decimal(out, request.time_ps);
    out += ',';
    append_decimal(out, request.frame);
    out += ',';
    append_decimal(out, request.surface);
    out += request.write ? ",write," : ",read,";
    out += name_of(request.part);
    out += ',';
    append_hex(out, request.address);
    out += ',';
    append_decimal(out, request.bytes);
    if (content_) out += ',';
    for (const uint8_t byte : request.content) {
      constexpr char kDigits[] = "0123456789abcdef";
      out += kDigits[byte >> 4];
      out += kDigits[byte & 15];
    }
    out += '\n';
  }

 private:
  const bool content_;
};

/// 0xADDRESS READ|WRITE CYCLE
class Dramsim3Formatter : public TraceFormatter {
 public:
  explicit Dramsim3Formatter(double clock_mhz) : cycles_per_ps_(clock_mhz / 1e6) {}
  void append(const MemoryRequest& request, std::string& out) override {
    append_hex(out, request.address);
    out += request.write ? " WRITE " : " READ ";
    append_decimal(out, static_cast<uint64_t>(static_cast<double>(request.time_ps) * cycles_per_ps_));
    out += '\n';
  }

 private:
  const double cycles_per_ps_;
};

/// LD|ST 0xADDRESS, and with data: LD ADDRESS BYTES, or ST ADDRESS BYTES and each byte in decimal.
class Ramulator2Formatter : public TraceFormatter {
 public:
  Ramulator2Formatter(bool swap, bool content) : swap_(swap), content_(content) {}
  void append(const MemoryRequest& request, std::string& out) override {
    const bool store = request.write != swap_;
    out += store ? "ST " : "LD ";
    append_hex(out, request.address);
    if (content_) {
      out += ' ';
      append_decimal(out, request.bytes);
      if (store)
        for (const uint8_t byte : request.content) {
          out += ' ';
          append_decimal(out, byte);
        }
    }
    out += '\n';
  }

 private:
  const bool swap_, content_;
};

/// R|W channel,rank,bankgroup,bank,row,column. From the lowest address bit up: channel, column, rank, bank
/// group, bank, row. Rows beyond the last begin again at 0.
class VectorFormatter : public TraceFormatter {
 public:
  VectorFormatter(const std::array<uint32_t, kDramLevels>& levels, uint32_t request_bytes)
      : levels_(levels), request_bytes_(request_bytes) {}
  void append(const MemoryRequest& request, std::string& out) override {
    constexpr size_t kFromLowest[kDramLevels] = {0, 5, 1, 2, 3, 4};
    uint64_t left = request.address / request_bytes_;
    std::array<uint64_t, kDramLevels> entry{};
    for (const size_t level : kFromLowest) {
      entry[level] = left & (levels_[level] - 1);
      left >>= std::countr_zero(levels_[level]);
    }
    out += request.write ? "W " : "R ";
    for (size_t level = 0; level < kDramLevels; ++level) {
      if (level > 0) out += ',';
      append_decimal(out, entry[level]);
    }
    out += '\n';
  }

 private:
  const std::array<uint32_t, kDramLevels> levels_;
  const uint32_t request_bytes_;
};

}  // namespace

std::unique_ptr<TraceFormatter> make_trace_formatter(const MemoryTraceOptions& options, uint32_t request_bytes) {
  switch (*options.format) {
    case TraceFormat::kGem5:
      return make_gem5_formatter();
    case TraceFormat::kDramsim3:
      return std::make_unique<Dramsim3Formatter>(options.clock_mhz);
    case TraceFormat::kRamulator2:
    case TraceFormat::kRamulator2Data:
      return std::make_unique<Ramulator2Formatter>(options.swap_load_store,
                                                   *options.format == TraceFormat::kRamulator2Data);
    case TraceFormat::kRamulator2Vectors:
      return std::make_unique<VectorFormatter>(options.levels, request_bytes);
    case TraceFormat::kCsv:
      break;
  }
  return std::make_unique<CsvFormatter>(options.content);
}

}  // namespace tilepress
