// Fuzz target for the scheme parser: any text gives a specification in its ranges, or one line that names the
// fault.
#include <cstdint>
#include <string>
#include <string_view>

#include "tilepress/scheme.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace tilepress;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  std::string error;
  const auto spec = parse_scheme(text, error, PaletteFiles::kLeave);  // opens no file
  if (!spec) {
    if (error.find("scheme '") != 0) __builtin_trap();
    return 0;
  }
  const FvcConfig& fvc = spec->fvc;
  if (spec->text != text || find_scheme(spec->name) == nullptr) __builtin_trap();
  if (fvc.entries < 2 || fvc.entries > 1024 || (fvc.entries & (fvc.entries - 1)) != 0) __builtin_trap();
  if (fvc.ways_per_set() == 0 || fvc.entries % fvc.ways_per_set() != 0) __builtin_trap();
  if (fvc.sample == 0 || fvc.period == 0 || !(spec->coverage >= 0 && spec->coverage <= 1)) __builtin_trap();
  if (spec->entries < 2 || spec->entries > 1024 || (spec->entries & (spec->entries - 1)) != 0)
    __builtin_trap();
  return 0;
}
