#!/usr/bin/env bash
# Shows that a fresh Debian 12 machine reaches the end of ./run and of ./test: a minimal root made by
# debootstrap, with nothing of this machine but its package mirror and a clone of this checkout's
# commit. What is not committed is not tested.
#
#   tests/e2e/fresh_machine.sh FOLDER [page]
#
# FOLDER: made by this script, 4 GB; remove it afterwards. page: then also the report page, with npm
# and chromium, which ./test does without. Needs root and debootstrap. Not part of ./test: it
# installs two hundred packages. Ends with status 0 and "fresh machine: ok", or not with 0.
set -euo pipefail
root=$(realpath -m "${1:?usage: fresh_machine.sh FOLDER [page]}")
source=$(cd "$(dirname "$0")/../.." && pwd)
commit=$(git -C "$source" rev-parse HEAD)
[ ! -e "$root" ] || { echo "$root is there already" >&2; exit 2; }

mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' | awk '$2 == "bookworm" {print $1}' | sort -u | head -n 1)
echo "== debootstrap from this machine's mirror"
log=$(mktemp)
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$log" 2>&1 || { tail "$log"; exit 1; }
rm "$log"

cleanup() { umount -lq "$root/proc" "$root/dev/shm" "$root/dev/pts" "$root/dev" || true; }
trap cleanup EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts"
mount -t tmpfs tmpfs "$root/dev/shm"
cp /etc/resolv.conf "$root/etc/"
# Security fixes come from where this machine gets them.
for list in $(find /etc/apt -name '*.list' -o -name '*.sources'); do
  if grep -q 'debian.*bookworm\|URIs:.*debian' "$list"; then cp "$list" "$root/etc/apt/sources.list.d/"; fi
done
rm -f "$root/etc/apt/sources.list"

git clone -q --no-checkout "$source" "$root/baraka"
git -C "$root/baraka" checkout -q --detach "$commit"
git -C "$root/baraka" log -1 --format='== commit %h %s'

# The end of what a command prints, and how long it took; its failure is this script's.
inside() {
  echo "== $1"
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
    chroot "$root" bash -c "cd /baraka && time $1" </dev/null 2>&1 | tail -n "${LINES_SHOWN:-40}"
}
inside ./run
inside "build/release/bin/baraka report results/case_study"
inside ./test
if [ "${2:-}" = page ]; then
  inside "apt-get install -qq -y --no-install-recommends chromium >/dev/null"
  inside "./setup report_page"
  inside "./test -R e2e.report"
fi
echo "fresh machine: ok"
