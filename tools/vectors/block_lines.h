// Block lines: the $readmemh lines of one block, and of an FVC and a CCD.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tilepress/bit_io.h"
#include "tilepress/fvc_follower.h"

namespace tilepress {

/// Appends `digits` hexadecimal digits.
void append_hex(uint64_t value, uint32_t digits, std::string& out);
/// Appends a line of `bits` bits, the next ones of `in`. The first bit is the highest of the number.
void append_bits_line(BitReader& in, uint64_t bits, std::string& out);

/// A line per entry, {valid, colour}: `entries` lines, the colours first.
std::string ccd_lines(std::span<const uint32_t> colors, uint32_t entries, uint32_t pixel_bits);
/// A line per slot, {valid, colour, count}.
std::string fvc_lines(const FvcState& state, uint32_t pixel_bits);
/// A line per slot: the sample that hit or filled it last.
std::string fvc_last_lines(const FvcState& state);

/// Bits of a count, and of the number of a sample.
constexpr uint32_t kCountBits = 32;

}  // namespace tilepress
