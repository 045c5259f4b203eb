# SPDX-License-Identifier: Apache-2.0
about="instructions of operations on Cortex-M3 and Cortex-M0+ (emulated) and on the host; compared with docs/speed.md"
minutes=1
packages=(cmake ninja-build=ninja g++ valgrind "${arm_packages[@]}" qemu-system-arm python3)

# Counts are the same on every host, as each instruction takes the same time on the clock of the emulated machine.
lane() {
  count_on_arm m3 cortex-m3 RelWithDebInfo && count_on_arm m0plus cortex-m0plus MinSizeRel && count_on_host || return
  local of=$results/instructions arm host
  arm="arm-none-eabi-g++ $(arm-none-eabi-g++ -dumpfullversion)"
  host="$(g++ -dumpmachine)-g++ $(g++ -dumpfullversion)"
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} \
    --committed "$root/tests/bench/instructions.txt" --page "$root/docs/speed.md" --table instructions --title operation \
    --percent 5 --stacks "$root/tests/bench/stacks.txt" \
    --column "Cortex-M3 -O2" "$arm" "$of-m3-lexican" "$of-m3-lexican_many_pdos" "$of-m3-lexican_od" \
    --column "Cortex-M0+ -Os" "$arm" "$of-m0plus-lexican" "$of-m0plus-lexican_many_pdos" "$of-m0plus-lexican_od" \
    --column "host -O2" "$host" "$of-host-lexican" "$of-host-lexican_many_pdos" "$of-host-lexican_od"
}

programs=(lexican lexican_many_pdos lexican_od)

build_bench() {  # NAME CMAKE-BUILD-TYPE CMAKE-ARGUMENT...
  build_tree "bench-$1" -DLEXICAN_PRESET=slave -DLEXICAN_BENCH=ON -DLEXICAN_TESTS=OFF -DLEXICAN_DEMO=OFF \
    -DLEXICAN_DRIVERS=OFF -DCMAKE_BUILD_TYPE="$2" "${@:3}"
}

count_on_arm() {  # NAME CPU CMAKE-BUILD-TYPE: -O2 or -Os
  build_bench "$1" "$3" -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_CPU="$2" || return
  local program
  for program in "${programs[@]}"; do
    run_counting "$results/instructions-$1-$program" timeout 300 qemu-system-arm -M mps2-an385 -display none \
      -monitor none -serial none -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host \
      -icount shift=10 -kernel "$build/bench-$1/tests/bench/${program}_instructions" || return
  done
}

count_on_host() {
  build_bench host RelWithDebInfo -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc || return
  local program of
  for program in "${programs[@]}"; do
    of=$results/callgrind-$program
    rm -f "$of".[0-9]*
    run_counting "$of.reports" timeout 300 valgrind --quiet --tool=callgrind --collect-atstart=no \
      --callgrind-out-file="$of" "$build/bench-host/tests/bench/${program}_instructions" &&
      run_counting "$results/instructions-host-$program" python3 "$root/tests/bench/callgrind/read.py" "$of.reports" \
        "$of".[0-9]* || return
  done
}

run_counting() {  # RESULT COMMAND...
  local result=$1
  shift
  "$@" >"$result" 2>&1 || {
    fail "${result##*/}" "$result"
    return 1
  }
}
