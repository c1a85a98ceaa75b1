// FVC differences: compares two FVCs slot for slot.
#pragma once

#include <string>

#include "dcp/fvc.h"

/// Lists the slots that differ, and "samples" if those do.
inline std::string fvc_differences(const tilepress::Fvc& a, const tilepress::Fvc& b) {
  std::string text;
  for (uint32_t slot = 0; slot < a.slots(); ++slot)
    if (a.count(slot) != b.count(slot) || (a.valid(slot) && a.color(slot) != b.color(slot)))
      text += " " + std::to_string(slot);
  if (a.samples() != b.samples()) text += " samples";
  return text;
}
