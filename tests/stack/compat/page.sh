#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Usage: page.sh PAGE TESTS
# Checks that each test named in docs/from-canopen-stack.md exists: cases in quotes ("SDO client: ..."), and functions
# of programs of tests/stack/compat (program.test_...).
set -u
page=$1
tests=$2
failed=0

# Joins wrapped lines; a quotation that contains ": " is the name of a case.
text=$(tr '\n' ' ' <"$page")
cases=$(printf '%s' "$text" | grep -oE '"[A-Za-z0-9 ]+: [^"]+"' | tr -d '"' | sort -u)
[ "$(printf '%s\n' "$cases" | wc -l)" -ge 15 ] || { echo "$page: hardly any case is found"; exit 1; }

# Compares only the first piece of a name, as sources may split names over two lines.
printf '%s\n' "$cases" | (
  while IFS= read -r name; do
    grep -rqF --include='*.cpp' -- "$name" "$tests" ||
      { echo "$page: there is no test case \"$name\""; failed=1; }
  done
  exit $failed
) || failed=1

for name in $(printf '%s' "$text" | grep -oE '[a-z_]+\.test_[a-z0-9_]+' | sort -u); do
  grep -q "RUN_TEST(${name#*.})" "$tests/stack/compat/${name%%.*}.c" || { echo "$page: there is no test $name"; failed=1; }
done
exit $failed
