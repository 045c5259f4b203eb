#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Checks the configuration of a program against that of the library that it is linked with:
#   configuration.sh link PROJECT LIBRARY COMPILER...      a program with another configuration is not linked
#   configuration.sh settings PROJECT COMPILER...          each setting of co_cfg.h changes the linker symbol
#   configuration.sh presets PROJECT COMPILER...           a definition has priority over each setting of each preset
# COMPILER... includes its options: the language and, for link, the configuration of LIBRARY.
set -u
what=$1 project=$2
shift 2
includes=(-I "$project/include" -I "$project/config")
strict=(-Wall -Wextra -Wpedantic -Wundef -Werror)
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT
failures=0

fail() {
  echo "FAILED $*" >&2
  failures=$((failures + 1))
}

# build OPTION...: compiles other_configuration.c with "${compiler[@]}"
build() { "${compiler[@]}" "${includes[@]}" "${strict[@]}" "$@" -x none "$library" -o "$directory/program" >"$directory/said" 2>&1; }

check_link() {
  library=$1
  shift
  compiler=("$@" "$project/tests/stack/compat/other_configuration.c")
  local only other function
  for only in "" -DONLY_EX; do
    for lto in "" -flto; do
      build $only $lto || { fail "the same configuration is refused ($only $lto):"; cat "$directory/said" >&2; }
    done
    function=CONodeInit${only:+Ex}
    for other in -DCO_HBCONS_N=3 -DCO_PARA_PERIOD=1234 "-DCO_HBCONS_N=3 -DCO_PARA_PERIOD=1234"; do
      # shellcheck disable=SC2086
      if build $only $other; then
        fail "$function is linked with $other"
      elif ! grep -q "${function}_SSDO[0-9]*_RPDO" "$directory/said"; then
        fail "$other is refused, but not by name:"
        cat "$directory/said" >&2
      fi
    done
    build $only "-DCO_HBCONS_N=(1 + 2)" || { fail "an expression is not accepted:"; cat "$directory/said" >&2; }
  done
}

# Prints the names of the settings in a header. Programs and libraries may differ in USE_ASSERT.
settings_in() { sed -nE 's/^#ifndef ((CO|USE)_[A-Z0-9_]+)$/\1/p' "$1" | grep -vE '_H_$|^CO_CFG_PRESET$|^USE_ASSERT$'; }

# symbol_with COMPILER...: prints a linker symbol with the configuration; nothing if the configuration is invalid
symbol_with() {
  printf '#include "lexican/detail/configuration.h"\nsymbol CO_CONFIGURED_SYMBOL("of")\n' |
    "$@" "${includes[@]}" -E -P - 2>/dev/null | sed -n 's/^symbol //p' | tr -d '" '
}

value_of() {  # SETTING COMPILER...
  printf '#include "co_cfg.h"\nvalue %s\n' "$1" | "${@:2}" "${includes[@]}" -E -P - | sed -n 's/^value //p'
}

check_settings() {
  local setting value other symbol all
  all=$(symbol_with "$@")
  [[ $all =~ ^of(_[A-Z]+[0-9]+)+$ ]] || fail "no symbol: $all"
  for setting in $(settings_in "$project/config/co_cfg.h"); do
    value=$(value_of "$setting" "$@")
    for other in $((value + 1)) $((value - 1)) $((value + 8)); do
      symbol=$(symbol_with "$@" "-D$setting=$other")
      [ -z "$symbol" ] || break
    done
    [ -n "$symbol" ] || fail "$setting: no other value is possible"
    ! grep -qxF -- "$symbol" <<<"$all" || fail "$setting=$other gives a symbol that there was: $symbol"
    all+=$'\n'$symbol
  done
  [ "$(wc -l <<<"$all")" -gt 35 ] || fail "settings are missing"
}

# Prints the other value of a switch, or 16 for a number.
check_presets() {
  local preset setting value other
  for preset in "$project"/config/presets/*.h; do
    for setting in CO_RPDO_N $(settings_in "$preset"); do
      value=$(value_of "$setting" "$@" "-DCO_CFG_PRESET=\"$preset\"")
      other=16
      [[ $setting != USE_* ]] || other=$((1 - value))
      [ "$setting" != USE_OBJ_EX ] || [ "$value" = 0 ] || continue
      printf '#include "co_cfg.h"\n#if %s != %s\n#error another value\n#endif\nextern int not_empty;\n' "$setting" "$other" |
        "$@" "${includes[@]}" "${strict[@]}" "-DCO_CFG_PRESET=\"$preset\"" "-U$setting" "-D$setting=$other" -fsyntax-only - ||
        fail "${preset##*/}: -D$setting=$other"
    done
    if grep -E '^#define (CO|USE)_' "$preset" | grep -v '_H_$' | awk '{ print $2 }' | sort | comm -23 - <(settings_in "$preset" | sort) | grep .; then
      fail "${preset##*/}: a setting without #ifndef"
    fi
  done
}

"check_$what" "$@"
[ $failures -eq 0 ]
