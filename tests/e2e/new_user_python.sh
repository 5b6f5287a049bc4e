#!/usr/bin/env bash
# Shows what a user of Python gets from the Debian packages alone, in a minimal Debian 12 root made by debootstrap: the part of docs/python.md
# that leads from the package to a figure, as it is written; a robot in URDF; results and environments; and capsules, which were made outside
# by the build tree, played to equal fingerprints.
#
#   ./setup packages && tests/e2e/new_user_python.sh FOLDER
#
# FOLDER: made by this script, 1 GB; remove it afterwards. Needs root and debootstrap, and about 20 minutes on a slow disk: not part of ./test
# or of .ci/run. Ends with status 0 and "new user of Python: ok", or not with 0.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
here=$source/tests/e2e
packages=$source/build/release/packages
ls "$packages"/{baraka,python3-baraka,baraka-sdf}_*.deb >/dev/null
source "$here/minimal_root.sh"

# Outside: a run and a campaign with a controller in Python.
baraka=$source/build/release/bin/baraka
made=$(mktemp -d)
export BARAKA_CONTROLLER_PATH=$here/python
"$baraka" run many_robots --seed 4 --until 30s --controllers in-process --set agents.robots.controller.program=help_robot.py \
  --out "$made/run" >/dev/null
printf '%s\n' 'version: 1' 'name: study' 'scenario: many_robots' 'replications: 2' 'until: 20 s' 'vary:' \
  '  control_phase: [aligned, uniform]' '  agents.robots.controller.program: [help_robot.py]' >"$made/study.yaml"
"$baraka" campaign "$made/study.yaml" --out "$made/study" >/dev/null
for one in run study; do "$baraka" capsule "$made/$one" -o "$made/$one.tar.zst" >/dev/null; done

minimal_root "${1:?usage: new_user_python.sh FOLDER}"
echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/thrown_away"
mkdir "$root/debs"
cp "$packages"/*.deb "$made"/*.tar.zst "$root/debs"
rm -r "$made"

LINES_SHOWN=6 place=/debs
inside "apt-get update"
inside "apt-get install -y --no-install-recommends ./baraka_*.deb ./python3-baraka_*.deb python3-pandas python3-matplotlib zstd"
chmod -R a+rX "$root/debs"
inside "useradd --create-home --shell /bin/bash ada"
"$here/page_commands.py" "$source/docs/python.md" "From the package to a figure" >"$root/debs/page.sh"
cp "$here/new_user/bot.urdf" "$here/new_user/from_python.py" "$root/home/ada/"

place=/home/ada as=ada LINES_SHOWN=40
inside "baraka run two_turtlebots | tee lines.txt; grep -qx 'fingerprint: d88f996bcf85a772' lines.txt"
inside "bash /debs/page.sh; tail -n 12 said.txt"
inside "! baraka capsule my_robot/results/speeds -o own.tar.zst; ! ls own.tar.zst"  # without the controller
inside "cd my_robot; BARAKA_CONTROLLER_PATH=. baraka capsule results/speeds -o ../own.tar.zst"
inside "python3 my_robot/my_robot.py --help"
inside "python3 from_python.py my_robot"
for one in /debs/run /debs/study /home/ada/own; do
  inside "mkdir -p played; cd played; mkdir -p ${one##*/}; tar -C ${one##*/} -xf $one.tar.zst; ${one##*/}/play.sh"
done

drive="--drive '{left: left, right: right}'"
inside "! baraka robot from bot.urdf $drive 2>said.txt; cat said.txt; grep -q baraka-sdf said.txt"
place=/debs as=root LINES_SHOWN=3
inside "apt-get install -y --no-install-recommends ./baraka-sdf_*.deb"
place=/home/ada as=ada LINES_SHOWN=40
inside "baraka robot from bot.urdf $drive >bot.yaml; baraka check bot.yaml; grep -q 'mass: 2 kg' bot.yaml"

place=/root as=root
inside "ls /usr/lib/python3/dist-packages/baraka/__pycache__ >/dev/null
  apt-get purge -y python3-baraka baraka-sdf >/dev/null; [ ! -e /usr/lib/python3/dist-packages/baraka ]; [ ! -e /usr/bin/baraka-sdf ]"
inside "su ada -c 'cd; export BARAKA_CONTROLLER_PATH=/home/ada/my_robot; ! baraka run my_robot/scenario.yaml --controllers in-process' 2>&1 |
  tee said.txt; grep -q 'of the package python3-baraka' said.txt"
echo "new user of Python: ok"
