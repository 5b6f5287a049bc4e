#!/usr/bin/env bash
# The scenario has no mistakes, what it expects comes true, and the controller does the same in the
# simulator's process as over DDS.     test.sh BARAKA SCENARIO
set -euo pipefail
baraka=$1 scenario=$2
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

fingerprint_of_run() {  # fails unless the run ends and what the scenario expects is met
  "$baraka" run "$scenario" --controllers "$1" --out "$results/$1" >"$results/$1.txt" || return
  sed -n 's/^fingerprint: //p' "$results/$1.txt"
}

"$baraka" check "$scenario"
in_process=$(fingerprint_of_run in-process)
over_dds=$(fingerprint_of_run spawn)
[ -n "$in_process" ] || { echo "$baraka prints no fingerprint" >&2; exit 1; }
if [ "$in_process" != "$over_dds" ]; then
  echo "in process $in_process, over DDS $over_dds: does it use a clock, a thread or a global?" >&2
  exit 1
fi
