# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# install_packages PACKAGE[=PROBE]...
#
# Installs the Debian packages that are missing and says which. A package counts as present when its probe is: a command
# name, or an absolute path (a pattern is allowed). Without a probe the package's name is the command. Returns 1, with the
# missing packages named, where it cannot install: no apt, neither root nor sudo, or a package that the archive lacks.

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

install_packages() {
  local missing
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
  echo "installing Debian packages: ${missing[*]}"
  local log
  log=$(mktemp)
  # The package lists of a fresh system are empty or old: a second attempt, with new ones.
  if ! apt_install "${missing[@]}" >"$log" 2>&1; then
    if ! { as_root apt-get update -q && apt_install "${missing[@]}"; } >"$log" 2>&1; then
      tail -n 5 "$log" >&2
      rm -f "$log"
      echo "could not install: ${missing[*]}" >&2
      return 1
    fi
  fi
  rm -f "$log"
}
