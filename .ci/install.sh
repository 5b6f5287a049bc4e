source "$(dirname "${BASH_SOURCE[0]}")/progress.sh"

# install_missing PACKAGE...: installs the Debian packages that are not there, and says which.
install_missing() {
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  echo "installing Debian packages: ${missing[*]}"
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "error: not root and no sudo; install the packages above, then try again" >&2
      return 1
    }
    root=(sudo)
  fi
  with_progress "package lists" "${root[@]}" apt-get update
  with_progress "installing" "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}
