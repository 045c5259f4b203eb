#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests that a codict built with -DLEXICAN_STATIC=ON needs no other files: static_test.sh CODICT FIXTURES. Prints TAP.
set -uo pipefail

codict=$1 fixtures=$2
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
number=0

report() {  # NAME COMMAND...
  number=$((number + 1))
  if "${@:2}" >"$place/said" 2>&1; then
    echo "ok $number - $1"
  else
    echo "not ok $number - $1: $(tr '\n' ' ' <"$place/said")"
  fi
}

needs_no_loader() { ! LC_ALL=C readelf --program-headers "$codict" | grep -E 'INTERP|NEEDED'; }
needs_no_library() { [[ $(LC_ALL=C ldd "$codict" 2>&1) == *'not a dynamic executable'* ]]; }
runs_without_environment() { env -i "$codict" --version; }

# Runs codict in a root directory that contains only the program and a description. The user namespace permits chroot
# for any user.
runs_in_empty_root() {
  mkdir "$place/root" && cp "$codict" "$place/root/codict" && cp "$fixtures/drive.eds" "$place/root" || return
  local chroot=(chroot)
  [ "$(id -u)" = 0 ] || chroot=(unshare --map-root-user chroot)
  env -i PATH="$PATH" "${chroot[@]}" "$place/root" /codict convert drive.eds -o drive.xdd && [ -s "$place/root/drive.xdd" ]
}

echo "1..4"
report "the program names no loader" needs_no_loader
report "ldd finds no library" needs_no_library
report "it runs without environment variables" runs_without_environment
report "it converts a description where there is no other file" runs_in_empty_root
