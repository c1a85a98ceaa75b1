// Trace value: one argument or result of a recorded call, and the reader that keeps or skips it.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "trace_stream.h"

namespace tilepress {

/// The kinds of values that the survey needs: numbers, short strings, and arrays of them.
struct TraceValue {
  enum class Kind : uint8_t { kNothing, kNumber, kText, kList };
  Kind kind = Kind::kNothing;
  int64_t number = 0;  ///< integers, booleans, enumerations, bit masks, pointers
  std::string text;
  std::vector<TraceValue> items;  ///< arrays and structures

  /// Returns the number, or the number in a one-element array, as output parameters are recorded.
  int64_t as_number(int64_t otherwise = 0) const;
};

/// Reads the values of a stream, and learns the enumerations, bit masks and structures that it defines.
class TraceValueReader {
 public:
  static constexpr uint32_t kMaxNesting = 64;
  static constexpr uint64_t kKeptBytesPerCall = 64 << 10;
  static constexpr size_t kMaxSignatures = 1 << 16;
  static constexpr uint64_t kMaxMembers = 1 << 16;

  explicit TraceValueReader(TraceStream& stream) : stream_(stream) {}
  /// Call before the first value: enumerations have another form before version 3.
  void set_version(uint64_t version) { version_ = version; }
  /// Starts a new memory budget, kKeptBytesPerCall. Values beyond the budget are skipped.
  void begin_call() { budget_bytes_ = kKeptBytesPerCall; }
  TraceValue read();
  /// Reads the same bytes and keeps none of them.
  void skip() { read(0, nullptr); }

 private:
  void read(uint32_t depth, TraceValue* into);  ///< null keeps nothing
  void read_items(uint64_t count, uint32_t depth, TraceValue* into);
  int64_t read_tagged_integer();
  int64_t read_enumeration();
  uint64_t read_bitmask();
  uint64_t read_structure_size();

  TraceStream& stream_;
  uint64_t version_ = 0;
  uint64_t budget_bytes_ = 0;
  std::unordered_map<uint64_t, int64_t> enumerations_;  ///< id to value before version 3, to 0 since
  std::unordered_set<uint64_t> bitmasks_;
  std::unordered_map<uint64_t, uint64_t> structures_;  ///< id to number of members
};

}  // namespace tilepress
