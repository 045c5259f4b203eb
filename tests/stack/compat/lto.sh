#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds and runs library and program with link-time optimisation, the table in one language and its use in the other.
# A warning of compiler or linker is a failure, except about initialisers with fewer values than members.
# lto.sh CC CXX PROJECT DOCTEST-DIRECTORY BUILD-DIRECTORY
set -eu
cc=$1 cxx=$2 project=$3 doctest=$4 build=$5
compat=$project/tests/stack/compat

for tool in "$cc" "$cxx"; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
done

rm -rf "$build"
mkdir -p "$build"
cd "$build"

# clang's objects need LLVM's linker.
linker=-flto-partition=one  # needs no make, and no warning about the number of processes
if [ "$cc" = clang ]; then
  linker=-fuse-ld=lld
  command -v ld.lld >/dev/null || { echo "skipped: no ld.lld"; exit 77; }
fi

warnings="-Wall -Wextra -Wno-missing-field-initializers -Werror"
includes="-I$project/include -I$project/config -I$project/src -I$project/tests/stack/support -I$compat -idirafter $doctest"
common="-O2 -flto $warnings $includes"
as_c="$cc -x c -std=c11 $common -c"
as_cpp="$cxx -x c++ -std=c++17 $common -c"

# Sources of different services have the same file name.
mkdir library
find "$project/src" -name '*.cpp' -printf '%P\n' | while read -r source; do
  # shellcheck disable=SC2086
  $as_cpp -fno-exceptions -fno-rtti "$project/src/$source" -o "library/$(echo "$source" | tr '/' '-').o"
done

# Without link-time optimisation, as the assertions are not tested here and doctest is large.
# shellcheck disable=SC2086
$cxx -std=c++17 -O0 $includes -c "$project/tests/stack/support/unity.cpp" "$compat/doctest.cpp"

for source in fakes mixed_table mixed_use; do
  $as_c "$compat/$source.c" -o $source.c.o
  $as_cpp "$compat/$source.c" -o $source.cpp.o
done

run() {  # TABLE-LANGUAGE USE-LANGUAGE
  # shellcheck disable=SC2086
  $cxx -O2 -flto $linker -Wodr "mixed_table.$1.o" "mixed_use.$2.o" "fakes.$1.o" unity.o doctest.o library/*.o \
    -o "table_$1_use_$2" 2>"warnings.$1.$2" || { cat "warnings.$1.$2"; exit 1; }
  if grep -q 'warning' "warnings.$1.$2"; then
    cat "warnings.$1.$2"
    echo "table in $1, use in $2: the linker warns"
    exit 1
  fi
  echo "== table in $1, use in $2"
  "./table_$1_use_$2"
}

run c cpp
run cpp c
