# SPDX-License-Identifier: Apache-2.0
about="each header alone as C11 and C++17, forbidden symbols in the library, and sources that compilers must reject with the expected message"
minutes=2
packages=("${build_packages[@]}" clang "${arm_packages[@]}" python3)

lane() {
  headers
  symbols
  local targets=(lexican)
  build_preset release && run_ctest failing_builds "$build/release/tests/stack/failing_builds"
}

# Each header alone

strict=(-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wundef -Werror -fsyntax-only)

headers() {
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

# Forbidden symbols: parts that are left out, heap, exceptions, C++ run time, static objects, software floating point

# Symbols that the library may require: functions that every C compiler assumes, and integer division, shifts and
# switches of the Arm run time, but no software floating point.
allowed='mem(cpy|move|set|cmp)|strlen|__aeabi_(u?idiv(mod)?|u?ldivmod|lmul|ll?sl|ll?sr|lasr|u?lcmp|idiv0|ldiv0|mem(cpy|move|set|clr)[48]?)'
allowed+='|__gnu_thumb1_case_[a-z]+|_GLOBAL_OFFSET_TABLE_'

symbols() {
  local targets=(lexican)
  build_library symbols-gcc -Os -DLEXICAN_PRESET=full -DCMAKE_CXX_COMPILER=g++ &&
    library gcc-size "$build/symbols-gcc/src/liblexican.a" nm objdump
  build_library symbols-clang -Os -DLEXICAN_PRESET=full -DCMAKE_CXX_COMPILER=clang++ &&
    library clang-size "$build/symbols-clang/src/liblexican.a" nm objdump
  build_library symbols-slave -O0 -DLEXICAN_PRESET=slave -DCMAKE_CXX_COMPILER=g++ &&
    check "slave without optimisation: no function of a part that is left out" needs_only_allowed nm "$build/symbols-slave/src/liblexican.a"
  targets=(lexican_full)
  build_m0plus -DLEXICAN_SIZES=ON &&
    library cortex-m0plus "$build/m0plus/tests/numbers/sizes/liblexican_full.a" arm-none-eabi-nm arm-none-eabi-objdump
  check "a C program is linked by gcc alone, without the C++ run time" links_as_c
  self_test
}

# Checks the symbols of the library.
library() {  # WHAT ARCHIVE NM OBJDUMP
  local what=$1 archive=$2 nm=$3 objdump=$4
  check "$what: has objects" has_objects "$nm" "$archive"
  check "$what: needs nothing but what is allowed" needs_only_allowed "$nm" "$archive"
  check "$what: no C++ run time in it" no_cpp_runtime "$nm" "$archive"
  check "$what: nothing runs before main" no_initialisers "$objdump" "$archive"
  check "$what: no memory of its own" no_memory "$objdump" "$archive"
}

has_objects() { [ "$("$1" --defined-only "$2" 2>/dev/null | grep -c ' [TtWw] ')" -gt 20 ]; }

# Checks the symbols that are undefined in one object and defined in none. Weak ones are excluded: they are defaults
# that the application may replace, or functions that it may define.
needs_only_allowed() {
  local needed
  needed=$(comm -23 <("$1" --undefined-only -f posix "$2" 2>/dev/null | grep -v ' [vw] *$' | symbol_names) \
    <("$1" --defined-only -f posix "$2" 2>/dev/null | symbol_names) | grep -vxE "$allowed")
  [ -z "$needed" ] || { echo "$needed"; return 1; }
}

symbol_names() { awk 'NF >= 2 { print $1 }' | sort -u; }

# Symbols of guards of static objects, virtual tables, type information, the standard library, exceptions, unwinding.
no_cpp_runtime() { ! "$1" -f posix "$2" 2>/dev/null | grep -E '^(_ZG|_ZT|_ZN?K?St|__cxa|__gxx|_Unwind|__aeabi_unwind)'; }

no_initialisers() { ! "$1" -h "$2" | grep -E ' \.(init_array|fini_array|ctors|dtors|preinit_array|gcc_except_table)'; }

# Checks that the library has no variables: the application supplies all memory, so there may be any number of nodes.
no_memory() {
  ! "$1" -h "$2" | awk '$2 ~ /^\.(data|bss|tdata|tbss)/ && $2 !~ /^\.data\.rel\.ro/ && $3 !~ /^0+$/ { print $2, $3 }' | grep .
}

links_as_c() {
  local program=$results/links_as_c
  cat >"$program.c" <<'C'
#include "co_core.h"
static CO_NODE node;
int main(void) {
  CONodeProcess(&node);
  COTmrService(&node.Tmr);
  return CODictFind(&node.Dict, CO_DEV(0x1000, 0)) != 0;
}
C
  gcc -o "$program" "$program.c" -I "$root/include" -I "$root/config" \
    -Wl,--whole-archive "$build/symbols-gcc/src/liblexican.a" -Wl,--no-whole-archive
}

# Checks that each check detects the fault that it is for.
self_test() {
  planted heap 'void* f() { return new int; }' needs_only_allowed nm
  planted "a library function" 'extern "C" int puts(const char*); int f() { return puts(""); }' needs_only_allowed nm
  planted "a virtual function" 'struct A { virtual int f(); }; int A::f() { return 1; }' no_cpp_runtime nm
  planted "a guarded static object" 'int g(); int f() { static int a = g(); return a; }' no_cpp_runtime nm
  planted "a throw" 'void f() { throw 1; }' no_cpp_runtime nm
  planted "a static constructor" 'int g(); int a = g();' no_initialisers objdump
  planted "a variable" 'int a = 1;' no_memory objdump
  planted "real arithmetic" 'double f(double a) { return a * 3; }' needs_only_allowed arm-none-eabi-nm arm-none-eabi-
}

planted() {  # WHAT SOURCE CHECK TOOL [COMPILER-PREFIX]
  local object=$results/planted.o
  "${5:-}g++" -c -x c++ -o "$object" - <<<"$2" || { fail "the self-test of '$1' does not compile"; return; }
  check "found: $1" finds "$3" "$4" "$object"
}

finds() { ! "$@"; }
