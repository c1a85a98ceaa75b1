#!/usr/bin/env bash
# Times replays beside the bare retracer, in pairs: time_replay.sh TILEPRESS TRACE... Prints wall and CPU seconds.
set -euo pipefail
tilepress=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unset DISPLAY
TIMEFORMAT='%R wall, %U user, %S system'
for trace in "$@"; do
  for round in 1 2 3; do
    rm -rf "$folder/out"
    bare=$({ time WAFFLE_PLATFORM=surfaceless_egl eglretrace -b "$trace" >/dev/null 2>&1; } 2>&1)
    ours=$({ time "$tilepress" replay -q -o "$folder/out" "$trace" >/dev/null 2>&1; } 2>&1)
    echo "$(basename "$trace") $round: bare $bare; replay $ours"
  done
done
