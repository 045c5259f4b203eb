# SPDX-License-Identifier: Apache-2.0
about="docs/porting.md: its code compiles for this host and Cortex-M0; its driver check, on the drivers of Lexican and on faulty ones"
minutes=2
packages=("${build_packages[@]}" python3 clang "${arm_packages[@]}")

lane() {
  porting_pages
  driver_check
}

strict=(-std=c11 -pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wundef -Wstrict-prototypes -Werror)

porting_pages() {
  run_tap python3 "$root/tests/programs/porting/excerpts.py" "$root" docs/porting.md
  run_tap python3 "$root/tests/programs/porting/excerpts.py" --some "$root" docs/drivers/bxcan.md
  run_tap python3 "$root/tests/programs/porting/excerpts.py" --some "$root" docs/drivers/mcp2515.md
  local page
  for page in flash_pages eeprom_i2c eeprom_spi; do
    run_tap python3 "$root/tests/programs/porting/excerpts.py" --some "$root" "docs/drivers/$page.md"
  done
  run_tap python3 "$root/tests/programs/porting/excerpts.py" --self-test
  local source
  for source in $(sources tests/programs/porting tests/drivers/driver_check/example drivers/template -name '*.c'); do
    compiles "$source" gcc
    compiles "$source" clang
    compiles "$source" arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -Wcast-align
  done
  check "the example is linked for Cortex-M0, within the promised size of the check" links_for_arm
  check "what the page names is there" names_what_exists
}

includes=(-I "$root/include" -I "$root/config" -I "$root/tests/drivers/driver_check" -I "$root/tests/drivers/driver_check/example")

compiles() {  # SOURCE COMPILER...
  local source=$1
  shift
  check "$source with $1" "$@" "${strict[@]}" "${includes[@]}" -c "$root/$source" -o /dev/null
}

# The size of the driver check that docs/porting.md states: flash and RAM in bytes.
flash=14500 ram=2000

links_for_arm() {
  local program=$results/check_my_port sources=("$root"/tests/drivers/driver_check/driver_check*.c)
  printf '%s\n' '#include "example_board.h"' 'EXAMPLE_CAN ExampleCan; EXAMPLE_TIMER ExampleTimer;' \
    'bool ExampleEepromRead(uint32_t a, uint8_t* b, uint32_t n) { (void)a; (void)b; (void)n; return false; }' \
    'bool ExampleEepromWrite(uint32_t a, const uint8_t* b, uint32_t n) { (void)a; (void)b; (void)n; return false; }' \
    'void COTmrLock(void) {}' 'void COTmrUnlock(void) {}' \
    'bool CORingInit(CO_RING* r, CO_IF_FRM* m, uint16_t n) { (void)r; (void)m; return n == 0; }' \
    'bool CORingGet(CO_RING* r, CO_IF_FRM* f) { (void)r; (void)f; return false; }' \
    'void CORingClear(CO_RING* r) { (void)r; }' \
    'uint16_t CheckMyPort(void (*print)(void*, const char*));' 'int main(void) { return CheckMyPort(0); }' >"$program.c"
  arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -Os -std=c11 -ffunction-sections -fdata-sections "${includes[@]}" "$program.c" \
    "$root/tests/programs/porting/check_my_port.c" "$root"/tests/drivers/driver_check/example/example_{can,timer,nvm}.c "${sources[@]}" \
    -nostartfiles --specs=nano.specs --specs=nosys.specs -Wl,--gc-sections -Wl,-e,main -o "$program" || return
  arm-none-eabi-size "$program" | tee /dev/stderr |
    awk -v flash="$flash" -v ram="$ram" 'NR == 2 { exit !($1 + $2 <= flash && $2 + $3 <= ram) }'
}

# Checks that paths of this project in `code` exist, and that the page's table has all checks.
names_what_exists() {
  local name missing=
  for name in $(grep -oE '`(tests|docs|drivers)/[a-z0-9_/.]+' "$root/docs/porting.md" | tr -d '`' | sort -u); do
    [ -e "$root/$name" ] || missing+=" $name"
  done
  for name in $(grep -ohE '"(can|timer|nvm)\.[a-z0-9]+"' "$root"/tests/drivers/driver_check/*.c | tr -d '"' | sort -u); do
    grep -q "^|.*\`$name\`.*|" "$root/docs/porting.md" || missing+=" $name"
  done
  [ -z "$missing" ] || { echo "missing:$missing"; return 1; }
}

# The driver check, which must detect the faults of faulty drivers

driver_check() {
  local targets=(driver_check_host) tree=$build/gcc/tests/drivers/driver_check
  sanitized_tree || return
  local files
  files=$(mktemp -d)
  run_tap "$tree/driver_check_host" "$files"
  rm -r "$files"
  check "on Cortex-M0 it needs nothing of the C library but string.h" needs_only_string_h
  check "the script feed answers as the check expects" feed_answers
}

needs_only_string_h() {
  local object=$results/driver_check.o source needed
  local sources=("$root"/tests/drivers/driver_check/driver_check*.c) objects=()
  for source in "${sources[@]}"; do
    objects+=("$results/$(basename "$source").o")
    arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -Os -std=c11 -Wall -Wextra -Wconversion -Wcast-align -Werror \
      -I "$root/include" -I "$root/config" -c "$source" -o "${objects[-1]}" || return
  done
  arm-none-eabi-ld -r -o "$object" "${objects[@]}" || return
  arm-none-eabi-size "$object"
  needed=$(arm-none-eabi-nm --undefined-only -f posix "$object" | cut -d ' ' -f 1 |
    grep -vxE 'mem(cpy|set|cmp)|COTmrLock|COTmrUnlock|__aeabi_u?idiv(mod)?|__gnu_thumb1_case_[a-z]+')
  [ -z "$needed" ] || { echo "needs $needed"; return 1; }
}

# Runs the script feed with replacements of can-utils that record their arguments.
feed_answers() {
  local work
  work=$(mktemp -d)
  printf '#!/bin/sh\ncat "%s"\n' "$work/heard" >"$work/candump"
  printf '#!/bin/sh\necho "cansend $*" >>"%s"\n' "$work/said" >"$work/cansend"
  printf '#!/bin/sh\necho "cangen $*" >>"%s"\n' "$work/said" >"$work/cangen"
  chmod +x "$work"/can*
  printf '(1.0) can0 %s\n' 122#A5C2 123#A5C2 1FFFFFFE#01 7FE# 702#R 7F0#10 7F1#0102030405060708 >"$work/heard"
  PATH=$work:$PATH "$root/tests/drivers/driver_check/feed" can0 || return
  diff - "$work/said" <<'SAID' && rm -r "$work"
cansend can0 123#A5C2
cansend can0 1FFFFFFF#01
cansend can0 7FF#
cansend can0 703#R
cangen can0 -g 0 -p 1000 -I 7F1 -L 8 -D i -n 16
SAID
}
