// Embedded font: DejaVu Sans Mono, taken from Debian's package when the window is built.
#pragma once

extern "C" const unsigned char kEmbeddedFont[];
