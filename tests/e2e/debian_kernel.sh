#!/usr/bin/env bash
# Runs two programs in lock-step on the kernel of Debian 12 (6.1), whatever this machine's is, and tells whether their frames are
# those of a run here: a virtual machine (qemu) that boots that kernel, with this machine's files, read-only, as its own. Then
# it takes from the kernel what lock-step needs, and shows what is said.
#
#   tests/e2e/debian_kernel.sh FOLDER
#
# FOLDER: made by this script, 500 MB; remove it afterwards. Needs root, packages qemu-system-x86, busybox-static, cpio and kmod, and
# Debian's mirror. ACCELERATOR=kvm makes it faster where that works. Not part of ./test. Ends with status 0 and "debian kernel: ok", or not with 0.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
bin=${BARAKA_BIN:-$source/build/release/bin}
folder=${1:?usage: debian_kernel.sh FOLDER}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
mkdir -p "$folder/out" "$folder/root/bin" "$folder/root/modules" "$folder/root/host" "$folder/root/out"
PATH=$PATH:/usr/sbin:/sbin

if [ ! -d "$folder/kernel" ]; then
  package=$(apt-cache depends linux-image-amd64 | sed -n 's/.*Depends: //p' | head -1)
  (cd "$folder" && apt-get download -qq "$package" 2>/dev/null)
  dpkg -x "$folder"/linux-image-*.deb "$folder/kernel"
fi
version=$(ls "$folder/kernel/lib/modules")
depmod -b "$folder/kernel" "$version"

# The modules in the order in which they are needed.
: > "$folder/root/modules/order"
for module in virtio_pci 9pnet_virtio 9p tun; do
  modprobe -d "$folder/kernel" -S "$version" --show-depends "$module"
done | awk '!seen[$2]++ {print $2}' | while read -r file; do
  cp "$file" "$folder/root/modules/"
  basename "$file" >> "$folder/root/modules/order"
done
cp "$(command -v busybox)" "$folder/root/bin/busybox"

cat > "$folder/out/held.yaml" <<YAML
version: 1
name: held
routing: none
record: {frames: all}
radio: {include: $source/config/radios/ieee80211g.yaml}
agents:
  a:
    name: a
    station: {}
    poses: [{x: 0 m, y: 0 m}]
    network: {}
    programs:
      - {name: ping, command: [ping, -i, 0.1, -c, 20, 10.77.0.2], on_exit: end}
      - {name: echo, command: [$source/build/release/tests/lockstep_echo, 10.77.0.2, 100]}
  b: {name: b, station: {}, poses: [{x: 10 m, y: 0 m}], network: {}, programs: [{name: echo, command: [$source/build/release/tests/lockstep_echo]}]}
end: [{at: 60 s, result: late}]
YAML

rm -rf "$folder/here" "$folder"/out/{log,result,refused}
cat > "$folder/root/init" <<'INIT'
#!/bin/busybox sh
/bin/busybox mkdir -p /proc
/bin/busybox mount -t proc none /proc
for module in $(/bin/busybox cat /modules/order); do /bin/busybox insmod "/modules/$module" || echo "no $module"; done
options=trans=virtio,version=9p2000.L,msize=262144
/bin/busybox mount -t 9p -o "$options,ro,cache=loose" host /host && /bin/busybox mount -t 9p -o "$options" out /out || exec /bin/busybox poweroff -f
for folder in proc sys dev tmp run; do /bin/busybox mount -t tmpfs none "/host/$folder"; done
/bin/busybox mount -t proc none /host/proc
/bin/busybox mount -t sysfs none /host/sys
/bin/busybox mount -t devtmpfs none /host/dev
/bin/busybox mkdir -p /host/dev/shm /host/dev/pts /host/tmp/out
/bin/busybox mount -t tmpfs none /host/dev/shm
/bin/busybox mount --move /out /host/tmp/out
/bin/busybox ip link set lo up
# Not by chroot: who has another root than its mounts makes no user namespaces.
exec /bin/busybox switch_root /host /bin/bash /tmp/out/inside.sh
INIT
chmod +x "$folder/root/init"

cat > "$folder/out/inside.sh" <<INSIDE
exec > /tmp/out/log 2>&1
export PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp LC_ALL=C.UTF-8
cd /tmp
uname -r
$bin/baraka run /tmp/out/held.yaml --no-inspect --out /tmp/held > /tmp/out/result 2>&1
echo "status \$?" >> /tmp/out/result
cp /tmp/held/a.ping.log /tmp/out/
echo 3 > /proc/sys/kernel/yama/ptrace_scope
$bin/baraka run /tmp/out/held.yaml --no-inspect --out /tmp/refused > /tmp/out/refused 2>&1
sync
echo o > /proc/sysrq-trigger
sleep 60
INSIDE

(cd "$folder/root" && find . | cpio -o -H newc --quiet) | gzip -1 > "$folder/initrd"
accelerator=${ACCELERATOR:-tcg}  # kvm inside a virtual machine may never boot
echo "== kernel $version, $accelerator"
timeout 1800 qemu-system-x86_64 -machine "accel=$accelerator" -cpu max -m 2G -smp 2 -nographic -no-reboot -nic none \
  -kernel "$folder/kernel/boot/vmlinuz-$version" -initrd "$folder/initrd" -append "console=ttyS0 panic=-1" \
  -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap \
  -virtfs "local,path=$folder/out,mount_tag=out,security_model=none" < /dev/null > "$folder/console" 2>&1
cat "$folder/out/log" "$folder/out/result"
grep -q '^status 0$' "$folder/out/result"

"$bin/baraka" run "$folder/out/held.yaml" --no-inspect --out "$folder/here" > "$folder/result_here"
digest() { sed -n 's/^frames_digest: //p' "$1"; }
echo "== frames_digest there $(digest "$folder/out/result"), here ($(uname -r)) $(digest "$folder/result_here")"
[ "$(digest "$folder/out/result")" = "$(digest "$folder/result_here")" ]
cmp "$folder/out/a.ping.log" "$folder/here/a.ping.log"
echo "== with kernel.yama.ptrace_scope=3"
cat "$folder/out/refused"
grep -q 'lock-step needs of the kernel what is missing here: /proc/PID/syscall (kernel.yama.ptrace_scope below 3): ' "$folder/out/refused"
echo "debian kernel: ok"
