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
source=$(cd "$(dirname "$0")/../.." && pwd)
commit=$(git -C "$source" rev-parse HEAD)
source "$source/tests/e2e/minimal_root.sh"
minimal_root "${1:?usage: fresh_machine.sh FOLDER [page]}"

git clone -q --no-checkout "$source" "$root/clone"
git -C "$root/clone" checkout -q --detach "$commit"
git -C "$root/clone" log -1 --format='== commit %h %s'

place=/clone
inside ./run
inside "build/release/bin/baraka report results/case_study"
inside ./test
if [ "${2:-}" = page ]; then
  inside "apt-get install -qq -y --no-install-recommends chromium >/dev/null"
  inside "./setup report_page"
  inside "./test -R e2e.report"
fi
echo "fresh machine: ok"
