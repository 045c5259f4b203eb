#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Usage: run.sh ROW COMPILER [OPTION...]
# Uses functions and types of the public headers that a setting leaves out: each must be refused with a message that
# names the setting. With the setting they must compile without a message. ROW is a line of names.txt.
set -u
row=$1
shift
off=$(printf '%s' "$row" | cut -d '|' -f 1)
on=$(printf '%s' "$row" | cut -d '|' -f 2)
setting=$(printf '%s' "$row" | cut -d '|' -f 3)
names=$(printf '%s' "$row" | cut -d '|' -f 4)

source_text() {
  printf '#include "co_core.h"\n#include "co_od.h"\nvoid use(void);\nvoid use(void) {\n'
  printf '  (void)&%s;\n' $names
  printf '}\n'
}

fail() {
  printf '%s\n%s\n' "$said" "$1" >&2
  exit 1
}

said=$(source_text | LC_ALL=C "$@" $on -fsyntax-only - 2>&1) || fail "does not compile with $on"
[ -z "$said" ] || fail "compiles with messages with $on"

if said=$(source_text | LC_ALL=C "$@" $off -fsyntax-only - 2>&1); then fail "compiles with $off, but must not"; fi
for name in $names; do
  printf '%s\n' "$said" | grep -Eq "error: .*\\b$name\\b.* is unavailable: needs $setting above 0 in co_cfg.h" ||
    fail "no message that $name needs $setting"
done
