# SPDX-License-Identifier: Apache-2.0
about="the driver check of docs/porting.md on the drivers of Lexican, and on faulty drivers, whose faults it must detect"
minutes=2
packages=("${build_packages[@]}" "${arm_packages[@]}")

lane() {
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
