# SPDX-License-Identifier: Apache-2.0
about="each header alone, as C11, as C++17 and inside extern \"C\" of C++17, gcc and clang"
minutes=1
packages=(g++ clang)

strict=(-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wundef -Werror -fsyntax-only)

lane() {
  local header
  for header in $(sources include config drivers -name '*.h'); do
    header_alone "$header" c c11
    header_alone "$header" c++ c++17
  done
  for header in $(sources include config drivers -name '*.h') $(sources include -name '*.hpp'); do
    header_alone "$header" c++ c++17 'extern "C" {' '}'
  done
  for header in $(sources include drivers -name '*.hpp'); do
    header_alone "$header" c++ c++17
  done
}

# Compiles a header alone. A declaration is appended, because C requires one in a translation unit and some headers
# contain only macros. A configuration preset is included by co_cfg.h.
header_alone() {  # HEADER LANGUAGE STANDARD [BEFORE AFTER]
  local source="#include \"$1\"" compiler
  [[ $1 != config/presets/* ]] || source="#define CO_CFG_PRESET \"${1#config/}\"
#include \"co_cfg.h\""
  source="${4:-}"$'\n'"$source"$'\n'"${5:-}"
  for compiler in gcc clang; do
    check "$1 as $3 ${4:+in $4 $5 }with $compiler" "$compiler" -x "$2" -std="$3" "${strict[@]}" \
      -I "$root" -I "$root/include" -I "$root/config" - <<<"$source"$'\nextern int not_empty;'
  done
}
