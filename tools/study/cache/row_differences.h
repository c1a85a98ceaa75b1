// Row differences: each byte less the byte one row above, as far as there is a row above.
#pragma once

#include <cstddef>

namespace tilepress {

/// Writes the differences of bytes [begin, end) of `frame` to `out`, modulo 256.
void take_row_differences(const std::byte* frame, size_t pitch, size_t begin, size_t end, std::byte* out);
/// The reverse. Bytes of `frame` before `begin` are set already.
void add_row_differences(const std::byte* in, size_t pitch, size_t begin, size_t end, std::byte* frame);

}  // namespace tilepress
