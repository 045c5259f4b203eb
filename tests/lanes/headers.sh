# SPDX-License-Identifier: Apache-2.0
about="each header alone, as C11, as C++17 and inside extern \"C\" of C++17, and the program of co_core.h, gcc and clang"
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
  local compiler
  for compiler in gcc clang; do
    check "the program in co_core.h with $compiler" program_compiles "$compiler"
  done
}

# Compiles the program in the comment at the head of co_core.h, with the declarations that it says are elsewhere.
program_compiles() {  # COMPILER
  local program
  program=$(sed -n 's,^///     ,,p' "$root/include/co_core.h")
  [[ $program == *CONodeInitCtx*'
}' ]] && "$1" -x c -std=c11 "${strict[@]}" -I "$root/include" -I "$root/config" - <<END
#include "co_core.h"
enum { OD_LENGTH = 2 };
extern CO_OBJ Od[OD_LENGTH];
extern const CO_IF_CAN_DRV_EX BoardCan;
extern const CO_IF_TIMER_DRV_EX BoardTimer;
void BoardTimerInterruptDisable(void);
void BoardTimerInterruptEnable(void);
void TimerInterrupt(void);
$program
END
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
