// Fuzz target for the scheme parser: any text gives specifications in their ranges, or one line that names
// the fault.
#include <cstdint>
#include <string>
#include <string_view>

#include "tilepress/scheme.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace tilepress;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  if (text.find("file=") == text.npos) {  // opens no file
    const auto specs = parse_schemes(text);
    if (!specs && specs.error().text.find("scheme '") != 0) __builtin_trap();
    if (specs && (specs->empty() || specs->size() > kMostSchemes)) __builtin_trap();
  }
  const auto spec = parse_scheme(text, SchemeFiles::kLeave);
  if (!spec) {
    if (spec.error().text.find("scheme '") != 0) __builtin_trap();
    return 0;
  }
  const SchemeInfo* info = find_scheme(spec->name);
  if (spec->text != text || info == nullptr || spec->values.size() != info->keys.size()) __builtin_trap();
  for (const SchemeKey& key : info->keys) {
    if (key.kind == KeyKind::kShare && !(spec->share(key.name) >= 0 && spec->share(key.name) <= 1))
      __builtin_trap();
    if (key.kind != KeyKind::kNumber && key.kind != KeyKind::kPowerOfTwo) continue;
    const uint32_t number = spec->number(key.name);
    if (number != key.initial && (number < key.low || number > key.high)) __builtin_trap();
    if (key.kind == KeyKind::kPowerOfTwo && (number & (number - 1)) != 0) __builtin_trap();
  }
  if (info->has_dcp_structures && spec->number("ways") != 0 &&
      spec->number("fvc") % spec->number("ways") != 0)
    __builtin_trap();
  return 0;
}
