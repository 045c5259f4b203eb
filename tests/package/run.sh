#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh WAY LANGUAGE DIRECTORY SOURCE PREFIX
# Builds the program main.c (LANGUAGE C) or main.cpp (CXX) in DIRECTORY against the library, whose sources are in SOURCE
# and which is installed in PREFIX, in one WAY of using it; and runs it. WAY readme runs the command lines of README.md and docs/use.md.
set -euo pipefail

way=$1 language=$2 directory=$3 source=$4 prefix=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
case $language in
  C) program=$here/main.c compiler=(gcc -std=c11) ;;
  CXX) program=$here/main.cpp compiler=(g++ -std=c++17) ;;
esac
rm -rf "$directory"
mkdir -p "$directory"

# A program whose configuration is not that of the installed library is not linked, and the linker's message says why.
# COMPILER OPTION...
build_and_refuse() {
  "$@" -o "$directory/consumer"
  if "$@" -DCO_RPDO_N=16 -o "$directory/refused" 2>"$directory/said"; then return 1; fi
  grep CONodeInit_of_a_library_with_the_same_co_cfg_values_ "$directory/said"
  ! grep -i warning "$directory/said"
}

by_cmake() {
  cmake --no-warn-unused-cli -S "$here/$way" -B "$directory" -G Ninja -DCONSUMER_LANGUAGE="$language" -DCONSUMER_SOURCE="$program" \
    -DLEXICAN_SOURCE="$source" -DCMAKE_PREFIX_PATH="$prefix"
  cmake --build "$directory"
  # Nothing of ours but the library gets into a user's build.
  [ -z "$(find "$directory" -name 'lexican_*' -o -name 'lexican-demo*')" ]
}

# The blocks of a LANGUAGE in README.md, "A complete program", and in docs/use.md, "Build, install, link".
readme_blocks() {
  awk -v language="$1" '
    /^## / { used = /^## (A complete program|Build, install, link)$/ }
    /^```/ { inside = used && $0 == "```" language; next }
    inside' "$source/README.md" "$source/docs/use.md"
}

# Packages are not installed here: what README names has to be there.
sudo() {
  [ "$*" != "apt-get update" ] || return 0
  [ "$1 $2" = "apt-get install" ] || return
  local package
  for package in "${@:3}"; do
    command -v "${package/ninja-build/ninja}" || { echo "README names $package, which is not here"; return 1; }
  done
}

# The commands of README.md and docs/use.md as a user follows them, in a copy of the sources and with a home directory of its own. There is no make: demo/run
# does not install it.
by_readme() {
  export HOME=$directory/home PATH=$directory/bin:$PATH
  mkdir -p "$directory/clone/firmware" "$directory/bin" "$HOME"
  ln -s /bin/false "$directory/bin/make"
  # tar would fail if another lane adds a file to the directory meanwhile.
  find "$source" -mindepth 1 -maxdepth 1 ! -name build ! -name .git -exec cp -a -t "$directory/clone" {} +
  cp "$program" "$directory/clone/firmware/main.c"
  readme_blocks cmake >"$directory/clone/firmware/CMakeLists.txt"
  mapfile -t commands < <(readme_blocks sh | sed -e ':join; /\\$/ { N; s/\\\n//; b join }')
  [ ${#commands[@]} -ge 6 ]
  cd "$directory/clone"
  unset CMAKE_GENERATOR CMAKE_BUILD_TYPE CMAKE_PREFIX_PATH PKG_CONFIG_PATH
  local command
  for command in "${commands[@]}"; do
    echo "\$ $command"
    eval "$command" || { echo "README: this command failed"; return 1; }
  done | tee "$directory/said"
  grep -x ' 500 ms, node 5: 705 7F' "$directory/said"
  grep -e '^-I.*/include/lexican -L.* -llexican' "$directory/said"
  grep -x 'CMAKE_BUILD_TYPE:STRING=Release' build/lexican/CMakeCache.txt
  mv firmware/build/firmware "$directory/consumer"
}

if [ "$way" = readme ]; then
  by_readme
  timeout 10 "$directory/consumer"
  exit
fi

library=$(dirname "$(find "$prefix" -name liblexican.a)")
case $way in
  pkg_config)
    export PKG_CONFIG_PATH=$library/pkgconfig
    read -ra flags < <(pkg-config --cflags --libs lexican)
    build_and_refuse "${compiler[@]}" "$program" "${flags[@]}"
    ;;
  bare_compiler)
    build_and_refuse "${compiler[@]}" -I "$prefix/include/lexican" -L "$library" "$program" -llexican
    ;;
  *) by_cmake ;;
esac
timeout 10 "$directory/consumer"

# A C program needs no C++ run time; by find_package and without CMake it does not even get it.
if [ "$language" = C ] && [ "$way" != add_subdirectory ] && [ "$way" != fetch_content ]; then
  ! ldd "$directory/consumer" | grep -F libstdc++
fi
