// Trace value: the reader that keeps or skips the arguments and results of recorded calls.
#include "trace_value.h"

namespace tilepress {
namespace {

// Numbers of the file format (apitrace's docs/FORMAT).
enum : uint8_t {
  kNull,
  kFalse,
  kTrue,
  kNegative,
  kPositive,
  kFloat,
  kDouble,
  kString,
  kBlob,
  kEnum,
  kBitmask,
  kArray,
  kStruct,
  kPointer,
  kRepresentation,
  kWideString,
};

void check_nesting(uint32_t depth) {
  if (depth > TraceValueReader::kMaxNesting) fail_corrupt("values are nested too deeply");
}

template <typename Table>
void check_room(const Table& table) {
  if (table.size() >= TraceValueReader::kMaxSignatures) fail_corrupt("too many type definitions");
}

}  // namespace

int64_t TraceValue::as_number(int64_t otherwise) const {
  if (kind == Kind::kNumber) return number;
  if (kind == Kind::kList && items.size() == 1) return items[0].as_number(otherwise);
  return otherwise;
}

int64_t TraceValueReader::read_tagged_integer() {
  const uint8_t type = stream_.read_byte();
  if (type != kNegative && type != kPositive) fail_corrupt("an enumeration's value is no integer");
  const uint64_t magnitude = stream_.read_uint();
  return static_cast<int64_t>(type == kNegative ? 0 - magnitude : magnitude);
}

int64_t TraceValueReader::read_enumeration() {
  const uint64_t id = stream_.read_uint();
  const auto known = enumerations_.find(id);
  if (version_ < 3) {  // a definition for each value
    if (known != enumerations_.end()) return known->second;
    check_room(enumerations_);
    stream_.skip_string();
    return enumerations_[id] = read_tagged_integer();
  }
  if (known == enumerations_.end()) {
    check_room(enumerations_);
    for (uint64_t left = stream_.read_uint(); left > 0; --left) {
      stream_.skip_string();
      read_tagged_integer();
    }
    enumerations_[id] = 0;
  }
  return read_tagged_integer();
}

uint64_t TraceValueReader::read_bitmask() {
  const uint64_t id = stream_.read_uint();
  if (!bitmasks_.contains(id)) {
    check_room(bitmasks_);
    for (uint64_t left = stream_.read_uint(); left > 0; --left) {
      stream_.skip_string();
      stream_.read_uint();
    }
    bitmasks_.insert(id);
  }
  return stream_.read_uint();
}

uint64_t TraceValueReader::read_structure_size() {
  const uint64_t id = stream_.read_uint();
  const auto known = structures_.find(id);
  if (known != structures_.end()) return known->second;
  check_room(structures_);
  stream_.skip_string();
  const uint64_t members = stream_.read_uint();
  if (members > kMaxMembers) fail_corrupt("a structure claims " + std::to_string(members) + " members");
  for (uint64_t left = members; left > 0; --left) stream_.skip_string();
  return structures_[id] = members;
}

TraceValue TraceValueReader::read() {
  TraceValue value;
  read(0, &value);
  return value;
}

void TraceValueReader::read_items(uint64_t count, uint32_t depth, TraceValue* into) {
  if (into != nullptr) into->kind = TraceValue::Kind::kList;
  for (; count > 0; --count) {
    const bool kept = into != nullptr && budget_bytes_ >= sizeof(TraceValue);
    read(depth, kept ? &into->items.emplace_back() : nullptr);
  }
}

void TraceValueReader::read(uint32_t depth, TraceValue* into) {
  check_nesting(depth);
  if (into != nullptr && budget_bytes_ < sizeof *into) into = nullptr;
  if (into != nullptr) budget_bytes_ -= sizeof *into;
  const auto number = [into](uint64_t bits) {
    if (into == nullptr) return;
    into->kind = TraceValue::Kind::kNumber;
    into->number = static_cast<int64_t>(bits);
  };
  const uint8_t type = stream_.read_byte();
  switch (type) {
    case kNull:
    case kFalse:
      return number(0);
    case kTrue:
      return number(1);
    case kNegative:
      return number(0 - stream_.read_uint());
    case kPositive:
    case kPointer:
      return number(stream_.read_uint());
    case kFloat:
      return stream_.skip(4);
    case kDouble:
      return stream_.skip(8);
    case kString:
      if (into == nullptr) return stream_.skip_string();
      into->kind = TraceValue::Kind::kText;
      into->text = stream_.read_string(budget_bytes_);
      budget_bytes_ -= into->text.size();
      return;
    case kBlob:
      return stream_.skip_string();
    case kEnum:
      return number(static_cast<uint64_t>(read_enumeration()));
    case kBitmask:
      return number(read_bitmask());
    case kArray:
      return read_items(stream_.read_uint(), depth + 1, into);
    case kStruct:
      return read_items(read_structure_size(), depth + 1, into);
    case kRepresentation:
      read(depth + 1, nullptr);      // for people
      return read(depth + 1, into);  // for machines
    case kWideString:
      for (uint64_t left = stream_.read_uint(); left > 0; --left) stream_.read_uint();
      return;
    default:
      fail_corrupt("unknown value type " + std::to_string(type));
  }
}

}  // namespace tilepress
