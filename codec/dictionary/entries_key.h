// Entries key: the size of a dictionary that is made from a whole frame.
#pragma once

#include "dictionary/color_table.h"
#include "tilepress/scheme.h"

namespace tilepress {

inline constexpr SchemeKey kEntriesKey = {.name = "entries",
                                          .kind = KeyKind::kPowerOfTwo,
                                          .summary = "colours of the dictionary",
                                          .low = 2,
                                          .high = kMostColors,
                                          .initial = 64,
                                          .range = KeyRange::kDoubling};

}  // namespace tilepress
