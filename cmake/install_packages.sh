# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# install_packages PACKAGE[=PROBE]...
#
# Installs missing Debian packages; prints their names, the number of packages that this installs, and their size. A
# package is present if its probe is: a command, or an absolute path (patterns are allowed); by default the command with
# the package's name. Returns 1, with the names of the missing packages, if it cannot install: without apt, without root
# and sudo, or if the archive does not have a package.

. "$(dirname "${BASH_SOURCE[0]}")/progress.sh"

# Libraries of the host programs in tools.
tool_packages=(libcli11-dev=/usr/include/CLI/CLI.hpp libfmt-dev=/usr/include/fmt/format.h
  nlohmann-json3-dev=/usr/include/nlohmann/json.hpp libpugixml-dev=/usr/include/pugixml.hpp
  libsocketcan-dev=/usr/include/libsocketcan.h libyaml-cpp-dev=/usr/include/yaml-cpp/yaml.h zlib1g-dev=/usr/include/zlib.h
  libncurses-dev=/usr/include/curses.h)

probe_found() {
  case $1 in
    /*) compgen -G "$1" >/dev/null ;;
    *) command -v "$1" >/dev/null || [ -x "/usr/sbin/$1" ] || [ -x "/sbin/$1" ] ;;
  esac
}

missing_packages() {
  local item
  for item in "$@"; do
    probe_found "${item#*=}" || echo "${item%%=*}"
  done | sort -u
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"
}

# Prints what apt-get would install, without root. Fails if the package lists do not contain all packages.
apt_plan() {
  local plan status
  plan=$(LC_ALL=C apt-get install --assume-no -q --no-install-recommends -o Debug::NoLocking=1 "$@" 2>&1)
  status=$?
  echo "$plan"
  [ $status -eq 0 ] || grep -qE '^(Abort|After this operation|Space needed)' <<<"$plan"
}

# Prints a summary of apt_plan's output: "23 packages, 45.2 MB to download, 201 MB on disk".
summary_of_plan() {
  sed -nE \
    -e 's/.* ([0-9]+) newly installed,.*/\1 packages/p' \
    -e 's/.*Installing: ([0-9]+),.*/\1 packages/p' \
    -e 's/^(Need to get|  Download size:) ([0-9.,]+ .?B).*/\2 to download/p' \
    -e 's/^(After this operation,|  Space needed:) ([0-9.,]+ .?B).*/\2 on disk/p' <<<"$1" | paste -sd '|' | sed 's/|/, /g'
}

install_packages() {
  local missing plan log
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  if ! command -v apt-get >/dev/null; then
    echo "missing (names of Debian packages): ${missing[*]}" >&2
    return 1
  fi
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    echo "missing, and neither root nor sudo to install them: ${missing[*]}" >&2
    return 1
  fi
  echo "missing Debian packages: ${missing[*]}"
  log=$(mktemp)
  as_root true || return 1  # asks for a password before the progress is shown
  # A fresh system has no package lists.
  if ! plan=$(apt_plan "${missing[@]}"); then
    with_progress "updating the package lists" "$log" as_root apt-get update -q || true
    plan=$(apt_plan "${missing[@]}") || true
  fi
  echo "installing them and what they need: $(summary_of_plan "$plan")"
  # Outdated lists name versions that the archive no longer has: the second attempt has new lists.
  if ! with_progress "installing packages" "$log" apt_install "${missing[@]}" && ! {
    with_progress "updating the package lists" "$log" as_root apt-get update -q &&
      with_progress "installing packages" "$log" apt_install "${missing[@]}"
  }; then
    tail -n 5 "$log" >&2
    rm -f "$log"
    echo "could not install: ${missing[*]}" >&2
    return 1
  fi
  rm -f "$log"
}
