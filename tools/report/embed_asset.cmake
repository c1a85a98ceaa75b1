# Writes OUTPUT, a C++ file that defines `const std::string_view tilepress::NAME` with the bytes of INPUT.
# Run as: cmake -DINPUT=... -DOUTPUT=... -DNAME=... -P embed_asset.cmake
file(READ "${INPUT}" hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
get_filename_component(source "${INPUT}" NAME)
file(WRITE "${OUTPUT}" "// Made from ${source} by embed_asset.cmake.
#include <cstddef>
#include <string_view>
namespace tilepress {
namespace {
constexpr unsigned char kBytes[] = {${bytes}0x00};
}
extern const std::string_view ${NAME};
const std::string_view ${NAME}(reinterpret_cast<const char*>(kBytes), sizeof kBytes - 1);
}  // namespace tilepress
")
