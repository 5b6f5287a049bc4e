#!/usr/bin/env bash
# Shows that a fresh Debian 12 machine reaches the end of ./run and of ./test: a minimal root made by
# debootstrap, with nothing of this machine but its package mirror and a clone of this repository.
#
#   tests/e2e/fresh_machine.sh FOLDER     FOLDER: made by this script, 4 GB; remove it afterwards
#
# Needs root and debootstrap. Not part of ./test: it installs two hundred packages.
set -euo pipefail
root=$(realpath -m "${1:?usage: fresh_machine.sh FOLDER}")
source=$(cd "$(dirname "$0")/../.." && pwd)
[ ! -e "$root" ] || { echo "$root is there already" >&2; exit 2; }

mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' | awk '$2 == "bookworm" {print $1}' | sort -u | head -n 1)
echo "== debootstrap from this machine's mirror"
log=$(mktemp)
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$log" 2>&1 || { tail "$log"; exit 1; }
rm "$log"

cleanup() { umount -lq "$root/proc" "$root/dev/shm" "$root/dev" || true; }
trap cleanup EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/dev/shm"
cp /etc/resolv.conf "$root/etc/"
# Security fixes come from where this machine gets them.
for list in $(find /etc/apt -name '*.list' -o -name '*.sources'); do
  if grep -q 'debian.*bookworm\|URIs:.*debian' "$list"; then cp "$list" "$root/etc/apt/sources.list.d/"; fi
done
rm -f "$root/etc/apt/sources.list"

git clone -q "$source" "$root/baraka"
inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root chroot "$root" "$@" </dev/null; }
for command in ./run "build/release/bin/baraka report results/case_study" ./test; do
  echo "== $command"
  inside bash -c "cd /baraka && time $command" 2>&1 | tail -n "${LINES_SHOWN:-25}"
done
