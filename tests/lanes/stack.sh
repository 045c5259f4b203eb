# SPDX-License-Identifier: Apache-2.0
about="stack depth of every API function on a Cortex-M0+; compared with docs/sizes.md"
minutes=1
packages=(cmake ninja-build=ninja python3 "${arm_packages[@]}")

lane() {
  local tree=$build/stack of=$results/stack
  build_tree stack -DLEXICAN_TESTS=OFF -DLEXICAN_DEMO=OFF -DLEXICAN_DRIVERS=OFF -DCMAKE_BUILD_TYPE=MinSizeRel \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_CPU=cortex-m0plus \
    -DCMAKE_CXX_FLAGS_MINSIZEREL="-Os -DNDEBUG -fstack-usage -fcallgraph-info=su,da" || return
  link_everything "$tree" "$of.elf" || return
  measure_depths "$tree" "$of" "$root/tests/stack/calls.txt"
  [ -f "$of-depths" ] || return
  self_test "$tree" "$of"
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/stack/depths.txt" \
    --page "$root/docs/sizes.md" --table stack --title function --remark "by way of" \
    --column "bytes" "arm-none-eabi-g++ $(arm-none-eabi-g++ -dumpfullversion)" "$of-depths"
}

measure_depths() {  # TREE RESULT CALLS
  rm -f "$2-depths"
  run_tap depths_of "$@"
}

depths_of() {  # TREE RESULT CALLS
  python3 -B "$root/tests/stack/depth.py" --objects "$1/src" --sources "$root/src" --calls "$3" --program "$results/stack.elf" \
    --tools arm-none-eabi- --depths "$2-depths" --ways "$2-ways"
}

# Links the functions of the C run time, whose instructions are evaluated, too.
link_everything() {  # TREE PROGRAM
  local objects
  mapfile -t objects < <(find "$1/src" -name '*.o*')
  arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb "${objects[@]}" -nostartfiles --specs=nano.specs --specs=nosys.specs \
    -Wl,-e,CONodeProcess -o "$2" >"$2.log" 2>&1 || { fail "link of the library" "$2.log"; return 1; }
}

# Checks that a call without a line in calls.txt and recursive functions are detected.
self_test() {  # TREE RESULT
  grep -v '^base/timer.cpp' "$root/tests/stack/calls.txt" >"$2-planted"
  check "found: a call without a line" is_refused "$@" "no line lists what timer.Func() may call"
  grep -v '^limit' "$root/tests/stack/calls.txt" >"$2-planted"
  check "found: a function that calls itself" is_refused "$@" "leads to a function that calls itself"
}

is_refused() {  # TREE RESULT WHY
  ! depths_of "$1" "$2-of-planted" "$2-planted" >"$2-refused" && grep "^not ok .*$3" "$2-refused"
}
