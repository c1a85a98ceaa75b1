#!/usr/bin/env bash
# Builds the preloaded library for AArch64 and runs the lookup probe under it in an emulator. Lookups must give the same
# results as without it, and the shim must have seen them. Needs the Debian packages gcc-aarch64-linux-gnu,
# libc6-dev-arm64-cross and qemu-user-static.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
programs=$root/tests/interposer/programs
compiler=aarch64-linux-gnu-gcc
emulator=qemu-aarch64-static
for tool in $compiler $emulator; do
  command -v $tool >/dev/null || { echo "tilepress: $tool: not found (gcc-aarch64-linux-gnu, qemu-user-static)" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

flags=(-std=gnu11 -O2 -fPIC -Wall -Wextra -Werror -fvisibility=hidden -I"$root" -I"$root/interposer")
$compiler -E -P -x c "$root/interposer/preload/exports.map.in" -o exports.map
$compiler "${flags[@]}" -ffreestanding -fno-tree-loop-distribute-patterns -fno-stack-protector \
  -fno-optimize-sibling-calls -mno-outline-atomics -nostartfiles -shared "$root"/interposer/preload/*.c "$root"/interposer/preload/*.S \
  -Wl,--version-script=exports.map -Wl,-z,defs -ldl -lpthread -o libtilepress-preload.so
$compiler -fPIC -shared -Wl,-soname,libEGL.so.1 "$programs/stub_egl.c" -o libEGL.so.1
$compiler -fPIC -shared "$programs/next_second.c" -o libnext_second.so
$compiler -fPIC -shared "$programs/next_first.c" -o libnext_first.so -ldl
$compiler -I"$root" "$programs/lookup_probe.c" -o lookup_probe -L. -Wl,--no-as-needed -lnext_first -lnext_second -ldl

run() { # run OUTPUT [NAME=VALUE]...: status 5 is the probe's own
  local output=$1 status=0 environment=()
  shift
  for setting in LD_LIBRARY_PATH="$work" "$@"; do environment+=(-E "$setting"); done
  $emulator -L /usr/aarch64-linux-gnu "${environment[@]}" ./lookup_probe >"$output" 2>&1 || status=$?
  [ $status -eq 5 ] || { echo "probe ended with $status" >&2; cat "$output" >&2; exit 1; }
}
mkdir session
run without
run with LD_PRELOAD="$work/libtilepress-preload.so" TILEPRESS_SESSION="$work/session"
diff without with || { echo "lookups differ" >&2; exit 1; }
grep -q "next of a library: 12" with
grep -q "egl eglSwapBuffers: found, no error" with
grep -q "eglSwapBuffers dlsym" session/*.seen || { echo "the shim has not seen the lookup" >&2; exit 1; }
echo "aarch64: $(wc -l <with) lines of lookups as without the shim; the shim saw: $(sort -u session/*.seen | tr '\n' ';')"
