// Trace builder: writes small apitrace traces, call by call, for tests.
#pragma once

#include <snappy.h>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// The bytes of one value (the numbers are those of apitrace's docs/FORMAT).
using Bytes = std::vector<uint8_t>;

inline void append_uint(Bytes& to, uint64_t value) {
  for (; value >= 0x80; value >>= 7) to.push_back(static_cast<uint8_t>(value | 0x80));
  to.push_back(static_cast<uint8_t>(value));
}
inline void append_text(Bytes& to, std::string_view text) {
  append_uint(to, text.size());
  to.insert(to.end(), text.begin(), text.end());
}
inline void append(Bytes& to, const Bytes& more) {
  to.insert(to.end(), more.begin(), more.end());
}

inline Bytes number(uint64_t value) {
  Bytes bytes = {0x04};
  append_uint(bytes, value);
  return bytes;
}
inline Bytes pointer(uint64_t value) {
  Bytes bytes = {0x0d};
  append_uint(bytes, value);
  return bytes;
}
inline Bytes text(std::string_view value) {
  Bytes bytes = {0x07};
  append_text(bytes, value);
  return bytes;
}
inline Bytes blob(size_t length) {
  Bytes bytes = {0x08};
  append_uint(bytes, length);
  bytes.resize(bytes.size() + length, 0xff);
  return bytes;
}
inline Bytes array(std::initializer_list<Bytes> items) {
  Bytes bytes = {0x0b};
  append_uint(bytes, items.size());
  for (const Bytes& item : items) append(bytes, item);
  return bytes;
}

class TraceBuilder {
 public:
  explicit TraceBuilder(uint64_t version = 6) : version_(version) {
    append_uint(stream_, version);
    if (version < 6) return;
    append_uint(stream_, version);
    append_text(stream_, "process.name");
    append_text(stream_, "/usr/bin/drawer");
    append_text(stream_, "");
  }

  uint64_t enter(const std::string& function, const std::vector<Bytes>& arguments, uint64_t thread = 0) {
    stream_.push_back(0);
    if (version_ >= 4) append_uint(stream_, thread);
    const auto [entry, added] = functions_.try_emplace(function, functions_.size());
    append_uint(stream_, entry->second);
    if (added) {
      append_text(stream_, function);
      append_uint(stream_, arguments.size());
      for (size_t i = 0; i < arguments.size(); ++i) append_text(stream_, "argument");
    }
    if (version_ < 4) {
      stream_.push_back(3);
      append_uint(stream_, thread);
    }
    for (size_t i = 0; i < arguments.size(); ++i) {
      stream_.push_back(1);
      append_uint(stream_, i);
      append(stream_, arguments[i]);
    }
    stream_.push_back(0);
    return next_call_++;
  }
  void leave(uint64_t call, const Bytes& result = {}) {
    stream_.push_back(1);
    append_uint(stream_, call);
    if (!result.empty()) {
      stream_.push_back(2);
      append(stream_, result);
    }
    stream_.push_back(0);
  }
  void call(const std::string& function, const std::vector<Bytes>& arguments, const Bytes& result = {},
            uint64_t thread = 0) {
    leave(enter(function, arguments, thread), result);
  }
  void swap(uint64_t surface, uint64_t thread = 0) {
    call("eglSwapBuffers", {pointer(1), pointer(surface)}, number(1), thread);
  }
  void make_current(uint64_t surface, uint64_t context, uint64_t thread = 0) {
    call("eglMakeCurrent", {pointer(1), pointer(surface), pointer(surface), pointer(context)}, number(1),
         thread);
  }
  void viewport(uint64_t width, uint64_t height, uint64_t thread = 0) {
    call("glViewport", {number(0), number(0), number(width), number(height)}, {}, thread);
  }
  void raw(std::initializer_list<uint8_t> bytes) { stream_.insert(stream_.end(), bytes); }

  const Bytes& stream() const { return stream_; }
  /// The stream in a snappy container, in chunks of `chunk_bytes`.
  Bytes file(size_t chunk_bytes = 1 << 20) const { return snappy_file(stream_, chunk_bytes); }

  static Bytes snappy_file(const Bytes& stream, size_t chunk_bytes = 1 << 20) {
    Bytes file = {'a', 't'};
    for (size_t at = 0; at < stream.size(); at += chunk_bytes) {
      std::string packed;
      snappy::Compress(reinterpret_cast<const char*>(stream.data()) + at,
                       std::min(chunk_bytes, stream.size() - at), &packed);
      for (int shift = 0; shift < 32; shift += 8)
        file.push_back(static_cast<uint8_t>(packed.size() >> shift));
      file.insert(file.end(), packed.begin(), packed.end());
    }
    return file;
  }

 private:
  uint64_t version_;
  uint64_t next_call_ = 0;
  Bytes stream_;
  std::map<std::string, uint64_t> functions_;
};

}  // namespace tilepress
