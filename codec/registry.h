// Registry: the schemes of the library, one line each in registry.cpp; each is defined beside its code.
#pragma once

#include "tilepress/scheme.h"

namespace tilepress {

extern const SchemeInfo kDcpInfo, kAdcpInfo, kVdcpInfo, kHuffDcpInfo, kRasInfo, kRedInfo, kHdcpInfo;
extern const SchemeInfo kPaletteInfo, kFbcInfo, kTeInfo, kBdiInfo, kBpcInfo;
extern const SchemeInfo kFpcInfo, kFpcdInfo, kCpackInfo, kFreqValsInfo, kHiloInfo, kMsaaInfo;
extern const SchemeInfo kIntel8Info, kIntel11Info, kAmdDccInfo;
extern const SchemeInfo kLccInfo;

}  // namespace tilepress
