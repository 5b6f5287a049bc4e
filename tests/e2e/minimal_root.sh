# minimal_root FOLDER: a Debian 12 root of nothing but debootstrap's minimum and this machine's package
# mirrors, with /proc and /dev until the script ends. inside COMMAND: runs a command in it.
# Needs root and debootstrap; sets `root`.
minimal_root() {
  root=$(realpath -m "$1")
  [ ! -e "$root" ] || { echo "$root is there already" >&2; exit 2; }
  local mirror log list
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' | awk '$2 == "bookworm" {print $1}' | sort -u | head -n 1)
  echo "== debootstrap from this machine's mirror"
  log=$(mktemp)
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$log" 2>&1 || { tail "$log"; exit 1; }
  rm "$log"

  trap 'umount -lq "$root/proc" "$root/dev/shm" "$root/dev/pts" "$root/dev" || true' EXIT
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
}

# The end of what a command prints, and how long it took; its failure is the script's. In the folder
# `place`, as the user `as`.
inside() {
  echo "== $1"
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME="${place:-/root}" LC_ALL=C.UTF-8 \
    chroot --userspec="${as:-root}" "$root" bash -ec "cd '${place:-/root}' && time { $1
}" </dev/null 2>&1 | tail -n "${LINES_SHOWN:-40}"
}
