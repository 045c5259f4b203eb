#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds lexican or codict as one file that needs no other: tools/static/build.sh PROGRAM [ARCHITECTURE
# [CMAKE-ARGUMENT...]]
#
# ARCHITECTURE is amd64, arm64 or armhf, by default that of this machine. The program for another one needs the
# compiler g++-aarch64-linux-gnu, g++-arm-linux-gnueabihf or g++-x86-64-linux-gnu. Its libraries are unpacked in the
# build directory, by an apt with its own lists: the machine does not change, and root is not needed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${1:-} architecture=${2:-$(dpkg --print-architecture)}
build=$root/build/static-$architecture
arguments=()

# Unpacks the development files of Debian's libraries for $architecture, with the libraries that they link to, as
# CMake's package files refuse an installation without these.
unpack_libraries() {  # DIRECTORY PACKAGE...
  local directory=$1 state=$1.apt packages
  shift
  [ ! -e "$directory" ] || return 0
  rm -rf "$directory".*
  mkdir -p "$state"/{lists,cache/archives}/partial "$directory.part"
  local own=(-q -o "APT::Architecture=$architecture" -o "APT::Architectures=$architecture" -o Dir::State::Status=/dev/null
    -o "Dir::State::Lists=$state/lists" -o "Dir::Cache=$state/cache" -o Debug::NoLocking=1 -o APT::Sandbox::User=
    -o Acquire::Languages=none)
  # apt leaves out a list that it cannot load or verify, such as while a mirror is updated; the others are enough.
  apt-get "${own[@]}" update || touch "$directory.outdated"
  mapfile -t packages < <(apt-cache "${own[@]}" depends --important "$@" |
    sed -nE 's/^  Depends: (lib|zlib)/\1/p' | grep -v '^libc6')
  (cd "$state" && apt-get "${own[@]}" download "$@" "${packages[@]}")
  local package
  for package in "$state"/*.deb; do
    dpkg-deb -x "$package" "$directory.part"
  done
  mv "$directory.part" "$directory"
}

case $architecture in
  amd64) triplet=x86_64-linux-gnu ;;
  arm64) triplet=aarch64-linux-gnu ;;
  armhf) triplet=arm-linux-gnueabihf ;;
  *)
    echo "$0: unknown architecture '$architecture'; it is amd64, arm64 or armhf" >&2
    exit 2
    ;;
esac
case $program in
  lexican) target=lexican_tool ;;
  codict) target=codict ;;
  *)
    echo "$0: unknown program '$program'; it is lexican or codict" >&2
    exit 2
    ;;
esac

if [ "$architecture" != "$(dpkg --print-architecture)" ]; then
  unpack_libraries "$build.libraries" libfmt-dev libncurses-dev libpugixml-dev libsocketcan-dev libyaml-cpp-dev zlib1g-dev
  arguments=(-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_C_COMPILER="$triplet-gcc" -DCMAKE_CXX_COMPILER="$triplet-g++"
    -DCMAKE_FIND_ROOT_PATH="$build.libraries")
fi
# The optimiser takes most of the build's time; the programs wait for the bus and for files.
cmake --no-warn-unused-cli -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
  -DLEXICAN_PRESET=sim -DLEXICAN_TOOLS=ON -DLEXICAN_STATIC=ON -DLEXICAN_DEMO=OFF -DLEXICAN_TESTS=OFF "${arguments[@]}" "${@:3}"
cmake --build "$build" --target "$target"
if [ -e "$build.libraries.outdated" ]; then
  echo "$0: warning: apt could not load all package lists: the libraries may lack security updates;" \
    "remove $build.libraries* to load them again" >&2
fi
ls -l "$build/tools/$program/$program"
