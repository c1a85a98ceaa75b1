// Little endian: the fields of file headers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tilepress {

inline void put_field(std::string& out, uint64_t value, uint32_t bytes) {
  for (uint32_t i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// Takes little-endian fields from bytes that outlive this and are long enough.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : at_(reinterpret_cast<const uint8_t*>(bytes.data())) {}
  uint64_t take(uint32_t bytes) {
    uint64_t value = 0;
    for (uint32_t i = 0; i < bytes; ++i) value |= uint64_t{*at_++} << (8 * i);
    return value;
  }
  uint32_t take4() { return static_cast<uint32_t>(take(4)); }

 private:
  const uint8_t* at_;
};

}  // namespace tilepress
