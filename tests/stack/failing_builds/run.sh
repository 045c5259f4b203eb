#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Usage: run.sh SOURCE COMPILER [OPTION...]
# Compiles a source that must not compile, and looks for the text of its "// expect:" lines in what the compiler says.
# A source with "// expect to compile" must compile without a word, one with "// expect a warning: " lines with their texts.
set -u
source=$1
shift

if said=$(LC_ALL=C "$@" -fsyntax-only "$source" 2>&1); then compiled=yes; else compiled=no; fi

fail() {
  printf '%s\n%s: %s\n' "$said" "$source" "$1" >&2
  exit 1
}

if grep -q '^// expect to compile$' "$source"; then
  [ $compiled = yes ] || fail 'does not compile'
  [ -z "$said" ] || fail 'compiles with warnings'
  exit 0
fi

if grep -q '^// expect a warning: ' "$source"; then
  [ $compiled = yes ] || fail 'does not compile'
else
  [ $compiled = no ] || fail 'compiles, but must not'
fi
expected=$(sed -n 's,^// expect\( a warning\)\{0\,1\}: ,,p' "$source")
[ -n "$expected" ] || fail 'has no line "// expect: TEXT"'
printf '%s\n' "$expected" | while IFS= read -r text; do
  printf '%s\n' "$said" | grep -qF -- "$text" || exit 1
done || fail "is refused, but without: $expected"
