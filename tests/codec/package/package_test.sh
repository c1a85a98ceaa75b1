#!/usr/bin/env bash
# The codec alone builds, installs, may be moved, and serves a program by CMake and by pkg-config.
# Usage: package_test.sh SOURCE_FOLDER WORK_FOLDER CXX [LAUNCHER]
set -euo pipefail
source=$1 work=$2 compiler=$3 launcher=${4:-}
export CMAKE_CXX_COMPILER_LAUNCHER=$launcher CXX=$compiler
rm -rf "$work/prefix" "$work/a place" "$work/user"
mkdir -p "$work/a place"
# The build folder stays: a second run compiles only what changed.
cmake -S "$source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTILEPRESS_CODEC_ONLY=ON >/dev/null
cmake --build "$work/build" -j2 >/dev/null
cmake --install "$work/build" --prefix "$work/prefix" >/dev/null
mv "$work/prefix" "$work/a place/moved"
prefix="$work/a place/moved"

echo "== find_package"
cmake -S "$source/tests/codec/package" -B "$work/user" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$work/user" >/dev/null
"$work/user/simulator"
"$work/user/gem5_stream"

echo "== pkg-config"
export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
[ "$(pkg-config --modversion tilepress-codec)" = "$(sed -n 's/^project(tilepress VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")" ]
eval "flags=($(pkg-config --cflags --libs tilepress-codec))"
"$compiler" "$source/tests/codec/package/simulator.cpp" -O1 -Wall -Wextra -Werror "${flags[@]}" -o "$work/user/by-pkg-config"
"$work/user/by-pkg-config"

echo "== every public header stands alone"
for header in "$prefix"/include/tilepress/*.h; do
  "$compiler" -x c++ -std=c++20 -Wall -Wextra -Wshadow -Werror -I"$prefix/include" -fsyntax-only - <<<"#include \"tilepress/$(basename "$header")\""
done
