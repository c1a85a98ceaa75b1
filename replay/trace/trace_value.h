// Trace value: one argument or result of a recorded call, and the reader that keeps or skips it.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "trace_stream.h"

namespace tilepress {

/// A value as far as this project looks at it: numbers, short strings, arrays of them.
struct TraceValue {
  enum class Kind : uint8_t { kNothing, kNumber, kText, kList };
  Kind kind = Kind::kNothing;
  int64_t number = 0;  ///< integers, booleans, enumerations, bit masks, pointers
  std::string text;
  std::vector<TraceValue> items;  ///< arrays and structures

  /// The number itself, or that of a one-element array, which is how output parameters are recorded.
  int64_t as_number(int64_t otherwise = 0) const;
};

/// Reads values of a stream and learns the enumerations, bit masks and structures that it defines on the way.
class TraceValueReader {
 public:
  static constexpr uint32_t kMaxNesting = 64;
  static constexpr uint64_t kKeptBytesPerCall = 64 << 10;
  static constexpr size_t kMaxSignatures = 1 << 16;
  static constexpr uint64_t kMaxMembers = 1 << 16;

  explicit TraceValueReader(TraceStream& stream) : stream_(stream) {}
  /// Must come before the first value: enumerations are written in another way before version 3.
  void set_version(uint64_t version) { version_ = version; }
  /// What a call's values may take in memory; values beyond it are skipped.
  void begin_call() { budget_bytes_ = kKeptBytesPerCall; }
  TraceValue read() { return read(0); }
  /// The same bytes, nothing kept.
  void skip() { skip(0); }

 private:
  TraceValue read(uint32_t depth);
  void skip(uint32_t depth);
  void skip_items(uint64_t count, uint32_t depth);
  void read_items(uint64_t count, uint32_t depth, TraceValue& into);
  int64_t read_tagged_integer();
  int64_t read_enumeration();
  uint64_t read_bitmask();
  uint64_t read_structure_size();

  TraceStream& stream_;
  uint64_t version_ = 0;
  uint64_t budget_bytes_ = 0;
  std::unordered_map<uint64_t, int64_t> enumerations_;  ///< id to value before version 3, else to nothing
  std::unordered_set<uint64_t> bitmasks_;
  std::unordered_map<uint64_t, uint64_t> structures_;  ///< id to number of members
};

}  // namespace tilepress
