#!/usr/bin/env bash
# Proves that the two commands of the README work where nothing is installed: makes a minimal Debian 12 with debootstrap, copies the
# committed tree in, and runs tools/quickstart (twice) and tools/check there. Root only; some 3 GB of disk and half an hour.
# `corpus` records and verifies a workload of each category; it needs quickstart before it.
# Usage: tests/prove_bare_machine.sh [quickstart|check|corpus]...    (the first two without arguments)
# TILEPRESS_CHROOT_TARBALL=FILE keeps the base system between calls.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ "$(id -u)" -eq 0 ] || { echo "prove_bare_machine: root only (chroot, mount)" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "prove_bare_machine: needs the package debootstrap" >&2; exit 2; }
parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=(quickstart check)

system=$(mktemp -d /var/tmp/tilepress-bare-XXXXXX)
clean_up() {
  for mounted in dev/pts dev/shm dev proc sys; do
    mountpoint -q "$system/$mounted" && umount -l "$system/$mounted"
  done
  rm -rf --one-file-system "$system"
}
trap clean_up EXIT

tarball=${TILEPRESS_CHROOT_TARBALL:-}
echo "== a bare Debian 12 in $system"
if [ -n "$tarball" ] && [ -f "$tarball" ]; then
  tar -C "$system" -xf "$tarball"
else
  debootstrap --variant=minbase bookworm "$system" "${TILEPRESS_MIRROR:-http://deb.debian.org/debian}" >/dev/null
  [ -z "$tarball" ] || tar -C "$system" -cf "$tarball" .
fi
chmod 755 "$system"  # apt drops its privileges for downloads
cp /etc/resolv.conf "$system/etc/resolv.conf"
mount -t proc proc "$system/proc"
mount -t sysfs -o ro sys "$system/sys"
mount --bind /dev "$system/dev"
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$system/dev/pts"
mount -t tmpfs tmpfs "$system/dev/shm"

mkdir -p "$system/src/tilepress"
git -C "$root" archive HEAD | tar -C "$system/src/tilepress" -xf -
inside() { chroot "$system" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 "$@"; }

verdict=0
prove() {
  local begin=$SECONDS
  echo "== $*"
  if inside bash -c 'cd /src/tilepress && exec "$@"' bash "$@"; then
    echo "== PROVED: $* in $((SECONDS - begin)) s"
  else
    echo "== FAILED: $* with status $? after $((SECONDS - begin)) s"
    verdict=1
  fi
}
for part in "${parts[@]}"; do
  case $part in
    quickstart) prove tools/quickstart; prove tools/quickstart ;;
    check) prove tools/check ;;
    corpus)
      prove build/release/tools/tilepress corpus record --install -o build/corpus gnome-calculator pentobi kubrick
      prove build/release/tools/tilepress corpus verify -o build/corpus
      ;;
    *) echo "prove_bare_machine: unknown part '$part'" >&2; exit 2 ;;
  esac
done
exit $verdict
