#!/usr/bin/env bash
# Proves the Containerfile without a container engine: runs its steps in systems made by debootstrap, then the entry point as
# process 1 of its own. It knows the instructions that the file has. Root only; some 3 GB of disk. Not part of the check.
# Usage: tests/prove_containerfile.sh [ARGUMENT]...    (arguments of the image; default: those of CMD)
# TILEPRESS_CHROOT_TARBALL=FILE keeps the base system between calls.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ "$(id -u)" -eq 0 ] || { echo "prove_containerfile: root only (chroot, mount)" >&2; exit 2; }

work=$(mktemp -d /var/tmp/tilepress-container-XXXXXX)
clean_up() {
  local mounted
  while read -r mounted; do umount -l "$mounted"; done < <(awk -v at="$work/" 'index($2, at) == 1 {print $2}' /proc/mounts | sort -r)
  rm -rf --one-file-system "$work"
}
trap clean_up EXIT

tarball=${TILEPRESS_CHROOT_TARBALL:-$work/base.tar}
if [ ! -f "$tarball" ]; then
  debootstrap --variant=minbase bookworm "$work/base" "${TILEPRESS_MIRROR:-http://deb.debian.org/debian}" >/dev/null
  tar -C "$work/base" -cf "$tarball" .
fi
mkdir "$work/context"
git -C "$root" archive HEAD | tar -C "$work/context" -xf -

begin_stage() {
  stage=$work/$1 folder=/ environment=(HOME=/root PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
  mkdir "$stage"
  tar -C "$stage" -xf "$tarball"
  chmod 755 "$stage"  # apt drops its privileges for downloads
  cp /etc/resolv.conf "$stage/etc/resolv.conf"
  mount -t proc proc "$stage/proc"
  mount --bind /dev "$stage/dev"
  mount -t tmpfs tmpfs "$stage/dev/shm"
}
inside() { chroot "$stage" /usr/bin/env -i "${environment[@]}" sh -c 'cd "$0" && exec "$@"' "$folder" "$@"; }
copy() {
  local from=$work/context target=${*: -1} source
  if [[ $1 == --from=* ]]; then from=$work/${1#--from=}; shift; fi
  [[ $target == /* ]] || target=$folder/$target
  # A folder's content is copied, not the folder.
  for source in "${@:1:$#-1}"; do
    if [ -d "$from/$source" ]; then source+=/.; fi
    if [[ $target == */ || $source == */. ]]; then mkdir -p "$stage/$target"; fi
    cp -a "$from/$source" "$stage/$target"
  done
}

entry=() arguments=() number=0
while read -r word rest; do
  case $word in
    '' | '#'*) continue ;;
    FROM) number=$((number + 1)); echo "== $word $rest"
          if [[ $rest == *' AS '* ]]; then begin_stage "${rest##* AS }"; else begin_stage "stage-$number"; fi ;;
    WORKDIR) folder=$rest; mkdir -p "$stage/$folder" ;;
    COPY) read -ra words <<<"$rest"; copy "${words[@]}" ;;
    ENV) environment+=("$rest") ;;
    RUN) echo "== RUN $rest"; inside sh -c "$rest" </dev/null ;;
    ENTRYPOINT) readarray -t entry < <(python3 -c 'import json, sys; print(*json.loads(sys.argv[1]), sep="\n")' "$rest") ;;
    CMD) readarray -t arguments < <(python3 -c 'import json, sys; print(*json.loads(sys.argv[1]), sep="\n")' "$rest") ;;
    *) echo "prove_containerfile: Containerfile: unknown instruction $word" >&2; exit 1 ;;
  esac
done < <(sed -e ':join' -e '/\\$/{N;s/\\\n *//;b join' -e '}' "$root/Containerfile")
[ $# -eq 0 ] || arguments=("$@")
echo "== ${entry[*]} ${arguments[*]}"
umount "$stage/proc"
unshare --pid --fork --kill-child chroot "$stage" /usr/bin/env -i "${environment[@]}" sh -c \
  'mount -t proc proc /proc && cd "$0" && exec "$@"' "$folder" "${entry[@]}" "${arguments[@]}"
