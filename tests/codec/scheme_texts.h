// Scheme texts: one specification for each way in which schemes read and write their bits.
#pragma once

namespace harness {

inline constexpr const char* kSchemeTexts[] = {
    "dcp",
    "dcp:fvc=2",
    "adcp",
    "vdcp",
    "vdcp:fvc=1024",
    "huffdcp",
    "huffdcp:fvc=256",
    "hdcp",
    "hdcp:fvc=16",
    "ras",
    "ras:ycocg=1",
    "ras:sizes=2",
    "ras:sizes=burst",
    "red",
    "palette",
    "palette:entries=2",
    "fbc",
    "fbc:entries=1024",
    "te",
    "bdi",
    "bdi:order=quad",
    "bpc",
    "bpc:order=quad",
    "fpc",
    "fpc:order=quad",
    "fpcd",
    "cpack",
    "freqvals",
    "freqvals:fvc=1024",
    "hilo",
    "msaa",
    "intel8",
    "intel11",
    "amddcc",
    "lcc",
    "lcc:fvc=512",
};

}  // namespace harness
