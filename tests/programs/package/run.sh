#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh WAY LANGUAGE DIRECTORY SOURCE PREFIX
# Builds the program main.c (LANGUAGE C) or main.cpp (CXX) in DIRECTORY against the library, whose sources are in SOURCE
# and which is installed in PREFIX, in one WAY of using it; and runs it.
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
  grep "CONodeInit_SSDO.*_RPDO16_" "$directory/said"
  ! grep -i warning "$directory/said"
}

by_cmake() {  # [LANGUAGES]
  cmake --no-warn-unused-cli -S "$here/$way" -B "$directory" -G Ninja -DCONSUMER_LANGUAGE="${1:-$language}" -DCONSUMER_SOURCE="$program" \
    -DLEXICAN_SOURCE="$source" -DCMAKE_PREFIX_PATH="$prefix"
  cmake --build "$directory"
  # Nothing of ours but the library gets into a user's build.
  [ -z "$(find "$directory" -name 'lexican_*' -o -name 'lexican-demo*')" ]
}

# A C program on the virtual bus. The lane runs the command lines of docs/integrate.md, too.
with_drivers() {
  program=$source/demo/first_node/first_node.c
  by_cmake "C;CXX"
  "$directory/consumer" >"$directory/said"
  grep -x ' 500 ms, node 5: 705 7F' "$directory/said"
}

# The files of docs/integrate.md, written afresh, with the defaults of the compiler; with them the drivers.
one_file() {
  local driver
  python3 "$source/cmake/one_file.py" "$directory"
  for preset in 3 2; do
    g++ -c -Os -Wall -Wextra -Werror -DLEXICAN_PRESET=$preset "$directory/lexican.cpp" -o "$directory/lexican.o"
  done
  if nm -C "$directory/lexican.o" | grep ' [BDRTVW] co::'; then return 1; fi
  for driver in "$source"/drivers/template/*.c "$source"/drivers/*/*/*.cpp; do
    gcc -fsyntax-only -Wall -Wextra -Werror -I "$source/include" -I "$directory" "$driver"
  done
  edited_settings_are_kept
  sed 's/co_core\.h/lexican.h/' "$program" >"$directory/main.c"
  build_and_refuse "${compiler[@]}" -Wall -Wextra -Werror "$directory/main.c" "$directory/lexican.o"
}

edited_settings_are_kept() {
  sed -i '/^#define LEXICAN_PRESET/s/2/1/' "$directory/lexican_config.h"
  cp "$directory/lexican_config.h" "$directory/edited"
  python3 "$source/cmake/one_file.py" "$directory" | grep -F 'lexican_config.h.new'
  cmp "$directory/edited" "$directory/lexican_config.h"
  grep -x '#define LEXICAN_PRESET 2' "$directory/lexican_config.h.new"
  mv "$directory/lexican_config.h.new" "$directory/lexican_config.h"
  python3 "$source/cmake/one_file.py" "$directory" | cmp - /dev/null
  [ ! -e "$directory/lexican_config.h.new" ]
}

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
  drivers) with_drivers ;;
  one_file) one_file ;;
  *) by_cmake ;;
esac
timeout 10 "$directory/consumer"

# A C program needs no C++ run time; by find_package and without CMake it does not even get it.
if [ "$language" = C ] && [ "$way" != drivers ]; then
  ! ldd "$directory/consumer" | grep -F libstdc++
fi
