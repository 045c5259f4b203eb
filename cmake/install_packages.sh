# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# install_packages PACKAGE[=PROBE]...
#
# Installs the Debian packages that are missing and says which, how many they bring along, and their size. A package counts as present when its probe is: a command
# name, or an absolute path (a pattern is allowed). Without a probe the package's name is the command. Returns 1, with the
# missing packages named, where it cannot install: no apt, neither root nor sudo, or a package that the archive lacks.

. "$(dirname "${BASH_SOURCE[0]}")/progress.sh"

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

# What apt-get would do, without root and without doing it. Fails if the package lists do not name all packages.
apt_plan() {
  local plan status
  plan=$(LC_ALL=C apt-get install --assume-no -q --no-install-recommends -o Debug::NoLocking=1 "$@" 2>&1)
  status=$?
  echo "$plan"
  [ $status -eq 0 ] || grep -qE '^(Abort|After this operation|Space needed)' <<<"$plan"
}

# "23 packages, 45.2 MB to download, 201 MB on disk", of what apt_plan has printed.
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
  # The package lists of a fresh system are empty.
  if ! plan=$(apt_plan "${missing[@]}"); then
    with_progress "updating the package lists" "$log" as_root apt-get update -q || true
    plan=$(apt_plan "${missing[@]}") || true
  fi
  echo "installing them and what they need: $(summary_of_plan "$plan")"
  # Old lists name versions that the archive no longer has: a second attempt, with new ones.
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
