# SPDX-License-Identifier: Apache-2.0
about="how many instructions operations take on Cortex-M3 and Cortex-M0+ (emulated), and that docs/speed.md tells it"
packages=(cmake ninja-build=ninja "${arm_packages[@]}" qemu-system-arm python3)

# Each instruction takes the same time on the clock of the emulated machine: every host counts the same.
lane() {
  count_on m3 cortex-m3 RelWithDebInfo && count_on m0plus cortex-m0plus MinSizeRel || return
  local of=$results/instructions
  run_tap python3 "$root/tests/bench/report.py" ${update_instructions:+--update} \
    --counts "$root/tests/bench/instructions.txt" --page "$root/docs/speed.md" \
    --compiler "$(arm-none-eabi-g++ -dumpfullversion)" \
    --m3 "$of-m3-lexican" "$of-m3-lexican_many_pdos" --m0plus "$of-m0plus-lexican" "$of-m0plus-lexican_many_pdos"
}

count_on() {  # NAME CPU CMAKE-BUILD-TYPE: -O2 or -Os
  build_tree "bench-$1" -DLEXICAN_PRESET=slave -DLEXICAN_BENCH=ON -DLEXICAN_TESTS=OFF -DLEXICAN_DEMO=OFF \
    -DLEXICAN_DRIVERS=OFF -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_CPU="$2" \
    -DCMAKE_BUILD_TYPE="$3" || return
  local program
  for program in lexican lexican_many_pdos; do
    count "$build/bench-$1/tests/bench/${program}_instructions" "$results/instructions-$1-$program" || return
  done
}

count() {  # PROGRAM RESULT
  timeout 300 qemu-system-arm -M mps2-an385 -display none -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config enable=on,target=native,chardev=host -icount shift=10 -kernel "$1" >"$2" 2>&1 || {
    fail "${1##*/}" "$2"
    return 1
  }
}
