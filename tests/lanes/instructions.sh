# SPDX-License-Identifier: Apache-2.0
about="instructions of operations and bytes of whole nodes on Cortex-M3 and Cortex-M0+ (emulated), and that docs/speed.md tells them"
packages=(cmake ninja-build=ninja "${arm_packages[@]}" qemu-system-arm python3)

# Each instruction takes the same time on the clock of the emulated machine: every host counts the same.
lane() {
  count_on m3 cortex-m3 RelWithDebInfo && count_on m0plus cortex-m0plus MinSizeRel || return
  local of=$results/instructions
  run_tap python3 "$root/tests/bench/report.py" ${update_instructions:+--update} \
    --counts "$root/tests/bench/instructions.txt" --page "$root/docs/speed.md" \
    --compiler "$(arm-none-eabi-g++ -dumpfullversion)" \
    --m3 "$of-m3-lexican" "$of-m3-lexican_many_pdos" "$of-m3-bytes" \
    --m0plus "$of-m0plus-lexican" "$of-m0plus-lexican_many_pdos" "$of-m0plus-bytes"
}

bare_metal=(-DLEXICAN_TESTS=OFF -DLEXICAN_DEMO=OFF -DLEXICAN_DRIVERS=OFF
  -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake")

count_on() {  # NAME CPU CMAKE-BUILD-TYPE: -O2 or -Os
  build_tree "bench-$1" -DLEXICAN_PRESET=slave -DLEXICAN_BENCH=ON "${bare_metal[@]}" -DLEXICAN_CPU="$2" \
    -DCMAKE_BUILD_TYPE="$3" || return
  local program
  for program in lexican lexican_many_pdos; do
    count "$build/bench-$1/tests/bench/${program}_instructions" "$results/instructions-$1-$program" || return
  done
  link minimal 1 "smallest node" "$@" >"$results/instructions-$1-bytes" &&
    link slave 0 "full node" "$@" >>"$results/instructions-$1-bytes"
}

count() {  # PROGRAM RESULT
  timeout 300 qemu-system-arm -M mps2-an385 -display none -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config enable=on,target=native,chardev=host -icount shift=10 -kernel "$1" >"$2" 2>&1 || {
    fail "${1##*/}" "$2"
    return 1
  }
}

# Prints the bytes of a linked node: drivers and C library are part of it as far as they are used.
link() {  # PRESET IS-SMALLEST WHAT NAME CPU CMAKE-BUILD-TYPE
  local tree=$build/bytes-$1-$4 program=$build/bytes-$1-$4/whole_node log=$results/link.log
  build_tree "bytes-$1-$4" -DLEXICAN_PRESET="$1" "${bare_metal[@]}" -DLEXICAN_CPU="$5" -DCMAKE_BUILD_TYPE="$6" >&2 || return
  arm-none-eabi-gcc -mcpu="$5" -mthumb -Os -ffunction-sections -fdata-sections -DCO_CFG_PRESET="\"presets/$1.h\"" \
    -DCO_NODE_IS_SMALLEST="$2" -I "$root/include" -I "$root/config" "$root/tests/bench/whole_node.c" \
    "$tree/src/liblexican.a" -nostartfiles --specs=nano.specs --specs=nosys.specs -Wl,--gc-sections -Wl,-e,main \
    -o "$program" >"$log" 2>&1 || {
    fail "link of the $3" "$log" >&2
    return 1
  }
  arm-none-eabi-size "$program" |
    awk -v what="$3" 'NR == 2 { print what ", bytes of flash\t" $1 + $2; print what ", bytes of RAM\t" $2 + $3 }'
}
