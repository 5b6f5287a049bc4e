#!/usr/bin/env bash
# Shows what a new user gets from the Debian packages alone: a minimal Debian 12 root made by
# debootstrap, with nothing of this machine but its package mirrors and the three .deb files. The user
# runs the case study, a scenario of their own, a controller of their own; robots of their own with one
# more sensor, looked at live, and a campaign with them; then the daemon comes.
#
#   ./setup packages && tests/e2e/new_user.sh FOLDER
#
# FOLDER: made by this script, 2 GB; remove it afterwards. Needs root and debootstrap. Not part of
# ./test. Ends with status 0 and "new user: ok", or not with 0.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
packages=$source/build/release/packages
ls "$packages"/{baraka,libbaraka-dev,baraka-agentd}_*.deb >/dev/null
source "$source/tests/e2e/minimal_root.sh"
minimal_root "${1:?usage: new_user.sh FOLDER}"
mkdir "$root/debs"
cp "$packages"/*.deb "$root/debs"
chmod -R a+rX "$root/debs"

LINES_SHOWN=6
install="apt-get install -y --no-install-recommends"
place=/debs
inside "apt-get update"
inside "$install ./baraka_*.deb"
inside "useradd --create-home --shell /bin/bash ada"

place=/home/ada as=ada LINES_SHOWN=40
inside "baraka run case_study.yaml | tee lines.txt; grep -qx 'result: arrived' lines.txt
  grep -qx 'fingerprint: 39f33e64d3cc8d56' lines.txt"
inside "ls /usr/share/baraka /usr/share/baraka/scenarios /usr/share/doc/baraka /usr/share/doc/baraka/docs/keys.md"
inside "! baraka run case_studdy.yaml"
cp "$source/tests/e2e/new_user/courtyard.yaml" "$root/home/ada/"
inside "baraka check courtyard.yaml"
inside "baraka run courtyard.yaml"
inside "sed 's/retry_jitter/retry_jiter/; s/tx_power: 0.1 mW/tx_power: 0.1 m/' courtyard.yaml >typo.yaml; ! baraka check typo.yaml"
inside "baraka run courtyard.yaml --replications 3 --controllers in-process --out results/many"
inside "baraka report results/many"

place=/debs as=root LINES_SHOWN=3
inside "$install ./libbaraka-dev_*.deb"
place=/home/ada as=ada LINES_SHOWN=40
inside "baraka new-controller wall_finder"
place=/home/ada/wall_finder
inside "cmake -B build -G Ninja >/dev/null; cmake --build build"
inside "ctest --test-dir build"
inside "BARAKA_CONTROLLER_PATH=\$PWD/build baraka run scenario.yaml"
inside "baraka report results/wall_finder"

# A robot of their own with one more sensor, driven by a controller of their own, looked at live, varied.
cp "$source"/tests/e2e/new_user/{my_burger,office,study}.yaml "$root/home/ada/"
place=/home/ada
inside "baraka list"
inside "baraka new-controller drive_around --from two_turtlebots
  cmake -S drive_around -B drive_around/build -G Ninja >/dev/null; cmake --build drive_around/build"
mine="export BARAKA_CONTROLLER_PATH=\$PWD/drive_around/build;"
inside "! baraka check office.yaml; $mine baraka check office.yaml; baraka check study.yaml"
inside "sed 's#robots/##' my_burger.yaml >lost.yaml; ! baraka check lost.yaml 2>said.txt
  cat said.txt; grep -q 'did you mean .robots/turtlebot3_burger.yaml' said.txt"
inside "$mine baraka run office.yaml --view --view-port 8123 --no-open --max-speed 20 >live.txt 2>&1 & run=\$!
  for i in {1..50}; do grep -q '^view: http' live.txt && break; sleep 0.1; done
  exec 3<>/dev/tcp/127.0.0.1/8123; printf 'GET / HTTP/1.0\r\nHost: 127.0.0.1:8123\r\n\r\n' >&3; head -n 1 <&3; exec 3>&-
  wait \$run; cat live.txt; grep -qx 'result: done' live.txt"
inside "baraka report results/office"
inside "$mine baraka campaign study.yaml; baraka report results/study; baraka report results/study -o study.html; ls study.html"

place=/debs as=root LINES_SHOWN=3
inside "$install ./baraka-agentd_*.deb"
inside "getent passwd baraka; ls -d /etc/baraka /usr/lib/systemd/system/baraka-agentd@.service"
LINES_SHOWN=10
# An agent that needs no device: the mote, on the loopback interface.
inside "sed 's/wlan0/lo, address: 127.77.93.1/' /usr/share/baraka/hardware/mote.yaml >/etc/baraka/m1.yaml
  timeout --preserve-status 3 baraka-agentd /etc/baraka/m1.yaml --domain 93 | tee said.txt
  grep -q '^ready: m1 (mote, address 2), .* domain 93' said.txt"
inside "apt-get purge -y baraka libbaraka-dev baraka-agentd >/dev/null; ! ls /usr/bin/baraka /usr/lib/baraka /usr/share/baraka"
echo "new user: ok"
