#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Usage: run.sh LEVEL COMPILER [OPTION...]
# Looks at what the compiler makes of the sources beside this script at a level of optimisation.
set -eu
level=$1
shift
here=$(dirname "$0")
object=$(mktemp)
trap 'rm -f "$object"' EXIT

fail() {
  printf '%s %s: %s\n' "$1" "$level" "$2" >&2
  nm -C "$object" >&2
  exit 1
}

# Without position independence a table of addresses is read-only for nm, too.
"$@" "$level" -fno-pie -c "$here/tables.cpp" -o "$object"
for table in table_const table_constexpr table_of_functions; do
  nm "$object" | grep -q " R $table\$" || fail tables.cpp "$table is not read-only"
done
if readelf -SW "$object" | grep -Eq '\.(init_array|ctors)'; then
  fail tables.cpp 'code runs at start-up'
fi

[ "$level" != -O0 ] || exit 0
"$@" "$level" -fno-pie -c "$here/constant_key.cpp" -o "$object"
for function in read_value read_variable write_variable; do
  nm -C "$object" | grep -q " T $function(" || fail constant_key.cpp "$function is not there"
done
left=$(nm -C "$object" | grep -Ev ' (T (read|write)_[a-z]*\(.*\)|U speed|[a-z] \$[a-z].*)$' || true)
[ -z "$left" ] || fail constant_key.cpp "is left in the program: $left"
