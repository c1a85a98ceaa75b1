#!/usr/bin/env bash
# The codec alone builds, installs, may be moved, and serves programs by CMake and by pkg-config: in C++, in C, as a
# plugin. The tree stays for the tests of the Python module.
# Usage: package_test.sh SOURCE_FOLDER WORK_FOLDER CXX CC [LAUNCHER]
set -euo pipefail
source=$1 work=$2 compiler=$3 c_compiler=$4 launcher=${5:-}
export CMAKE_CXX_COMPILER_LAUNCHER=$launcher CMAKE_C_COMPILER_LAUNCHER=$launcher CXX=$compiler CC=$c_compiler
tests=$source/tests/codec
rm -rf "$work/prefix" "$work/a place" "$work/user" "$work/plugin"
mkdir -p "$work/a place"
# The build folder stays: a second run compiles only what changed. Little is optimised: that would take minutes.
cmake -S "$source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
  -DTILEPRESS_CODEC_ONLY=ON -DTILEPRESS_PRECOMPILE=ON -DTILEPRESS_PYTHON=ON >/dev/null
cmake --build "$work/build" -j2 >/dev/null
cmake --install "$work/build" --prefix "$work/prefix" >/dev/null
mv "$work/prefix" "$work/a place/moved"
prefix="$work/a place/moved"
example=$prefix/share/doc/libtilepress-dev/examples/plugin

echo "== find_package"
cmake -S "$tests/package" -B "$work/user" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$work/user" >/dev/null
"$work/user/simulator"
"$work/user/gem5_stream"

echo "== the C library: figures of the golden frames, blocks, errors"
PYTHONPATH="$source/tests/tools" python3 - "$source/tests/golden/odd" >"$work/user/odd.rgba" <<'FRAMES'
import sys
from picture_files import read_png
for number in range(3):
    sys.stdout.buffer.write(read_png(f"{sys.argv[1]}/{number:03}.png")[3])
FRAMES
schemes="adcp dcp hdcp huffdcp ras ras:sizes=2 ras:sizes=burst ras:ycocg=1 red vdcp"
grep '^odd,,[12],' "$source/tests/golden/expected.csv" >"$work/user/expected"
use_c() { "$@" "$work/user/odd.rgba" 333 217 "$schemes" | diff "$work/user/expected" -; }
use_c "$work/user/c_user"

echo "== its names, and a later version of it"
library="$prefix/lib/libtilepress.so.0"
nm -D --defined-only "$library" | sed -n 's/.* T \(.*\)@@TILEPRESS_.*/\1/p' | sort | diff "$tests/package/c_symbols.txt" -
[ "$(nm -D --defined-only "$library" | grep -vc ' A TILEPRESS_')" = "$(wc -l <"$tests/package/c_symbols.txt")" ]
objdump -p "$library" | grep -q 'SONAME *libtilepress.so.0$'
mkdir "$work/user/later"
cp "$library" "$work/user/later/libtilepress.so.0.9.0"
ln -s libtilepress.so.0.9.0 "$work/user/later/libtilepress.so.0"
eval "flags=($(PKG_CONFIG_PATH="$prefix/lib/pkgconfig" pkg-config --cflags --libs tilepress))"
"$c_compiler" -std=c11 "$tests/package/c_user.c" "$example/rowpal_plugin.c" "${flags[@]}" -o "$work/user/c-by-pkg-config"
LD_LIBRARY_PATH="$work/user/later" use_c "$work/user/c-by-pkg-config"

echo "== a plugin"
cmake -S "$example" -B "$work/plugin" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$work/plugin" >/dev/null

echo "== pkg-config"
export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
[ "$(pkg-config --modversion tilepress-codec)" = "$(sed -n 's/^project(tilepress VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")" ]
eval "flags=($(pkg-config --cflags --libs tilepress-codec))"
"$compiler" "$tests/package/simulator.cpp" -O1 -Wall -Wextra -Werror "${flags[@]}" -o "$work/user/by-pkg-config"
"$work/user/by-pkg-config"

echo "== every public header stands alone"
for header in "$prefix"/include/tilepress/*.h; do
  "$compiler" -x c++ -std=c++20 -Wall -Wextra -Wshadow -Werror -I"$prefix/include" -fsyntax-only - <<<"#include \"tilepress/$(basename "$header")\""
done
for header in tilepress.h tilepress_plugin.h; do
  for language in "c -std=c11" "c++ -std=c++20"; do
    # shellcheck disable=SC2086
    "$c_compiler" -x $language -Wall -Wextra -pedantic -Werror -I"$prefix/include" -fsyntax-only - <<<"#include <$header>"
  done
done
