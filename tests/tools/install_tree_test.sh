#!/usr/bin/env bash
# An installed tree works, also after it has been moved to a path with a space.
# Usage: install_tree_test.sh BUILD_FOLDER
set -euo pipefail
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/first" >/dev/null
[ -x "$work/first/bin/tilepress" ] && [ -f "$work/first/lib/libtilepress-preload.so" ]
mkdir "$work/a place"
mv "$work/first" "$work/a place/moved"
tilepress="$work/a place/moved/bin/tilepress"
"$tilepress" --version
# The window is found where the tree lies now, and says what is missing itself.
told=$(env -u DISPLAY "$tilepress" view "$work" 2>&1) && exit 1
case $told in "tilepress: view: no display: DISPLAY is not set"*) ;; *) echo "view says: $told"; exit 1 ;; esac

start_x() {
  Xvfb -displayfd 7 -screen 0 640x480x24 -nolisten tcp -noreset 7>"$work/display" >/dev/null 2>&1 &
  x_pid=$!
  trap 'kill "$x_pid" 2>/dev/null || true; rm -rf "$work"' EXIT
  until [ -s "$work/display" ]; do sleep 0.1; kill -0 "$x_pid"; done
}
start_x
DISPLAY=":$(cat "$work/display")" "$tilepress" run -o "$work/out put" -s red -- \
  glmark2-es2 --size 64x64 -b build:nframes=5:duration=100 >/dev/null
rows=$(cat "$work/out put"/glmark2-es2-*/schemes.csv | wc -l)
[ "$rows" -eq 6 ] || { echo "expected a header and 5 rows, got $rows lines"; exit 1; }
