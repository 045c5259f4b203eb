# SPDX-License-Identifier: Apache-2.0
about="instructions of operations on Cortex-M3, Cortex-M0+ (emulated) and the host, of CAN drivers, and of the worst frame; compared with docs/speed.md"
minutes=2
packages=("${build_packages[@]}" valgrind "${arm_packages[@]}" qemu-system-arm python3)

lane() {
  build_library m3 -O2 -DLEXICAN_BENCH=ON -DLEXICAN_FRAME_BOUND=ON -DLEXICAN_CPU=cortex-m3 \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake" || return
  count_operations
  count_drivers
  count_worst_frame
}

arm="arm-none-eabi-g++ $(arm-none-eabi-g++ -dumpfullversion 2>/dev/null)"
host="$(g++ -dumpmachine 2>/dev/null)-g++ $(g++ -dumpfullversion 2>/dev/null)"

count_operations() {
  count_on_arm m3 && build_m0plus_programs && count_on_arm m0plus && count_on_host || return
  local of=$results/instructions
  report_operations instructions stacks \
    --column "Cortex-M3 -O2" "$arm" "$of-m3-lexican" "$of-m3-lexican_many_pdos" "$of-m3-lexican_od" \
    --column "Cortex-M3 -O2, features of the others" "$arm" "$of-m3-lexican_others_features-stacks" \
    --column "Cortex-M0+ -Os" "$arm" "$of-m0plus-lexican" "$of-m0plus-lexican_many_pdos" "$of-m0plus-lexican_od" \
    --column "Cortex-M0+ -Os, features of the others" "$arm" "$of-m0plus-lexican_others_features-stacks" \
    --column "host -O2" "$host" "$of-host-lexican" "$of-host-lexican_many_pdos" "$of-host-lexican_od"
  report_operations classic_drivers classic_stacks \
    --column "Cortex-M3 -O2" "$arm" "$of-m3-lexican_classic-classic_stacks" \
    --column "Cortex-M0+ -Os" "$arm" "$of-m0plus-lexican_classic-classic_stacks"
}

report_operations() {  # TABLE STACKS COLUMN...
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/numbers/bench/$1.txt" \
    --page "$root/docs/speed.md" --table "$1" --title operation --percent 3 --stacks "$root/tests/numbers/bench/$2.txt" "${@:3}"
}

programs=(lexican lexican_many_pdos lexican_od)
compared_programs=(lexican_others_features lexican_classic)  # on a Cortex-M only

build_m0plus_programs() {
  local targets=("${programs[@]/%/_instructions}" "${compared_programs[@]/%/_instructions}")
  build_m0plus -DLEXICAN_BENCH=ON
}

count_on_arm() {  # TREE
  local program of=$results/instructions-$1
  for program in "${programs[@]}" "${compared_programs[@]}"; do
    run_on_machine "$of-$program" "$build/$1/tests/numbers/bench/${program}_instructions" || return
  done
  keep_rows_of stacks "$of-lexican_others_features"
  keep_rows_of classic_stacks "$of-lexican_classic"
}

# Writes the rows that other stacks have to RESULT-STACKS.
keep_rows_of() {  # STACKS RESULT
  awk -F '\t| [|] ' 'NR == FNR { other[$1]; next } $1 in other' "$root/tests/numbers/bench/$1.txt" "$2" >"$2-$1"
}

# Counts are the same on every host, as each instruction takes the same time on the clock of the emulated machine.
run_on_machine() {  # RESULT PROGRAM
  run_counting "$1" timeout 300 qemu-system-arm -M mps2-an385 -display none -monitor none -serial none \
    -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host -icount shift=10 -kernel "$2"
}

count_on_host() {
  build_library host-O2 -O2 -DLEXICAN_BENCH=ON -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc || return
  local program of
  for program in "${programs[@]}"; do
    of=$results/callgrind-$program
    rm -f "$of".[0-9]*
    run_counting "$of.reports" timeout 300 valgrind --quiet --tool=callgrind --collect-atstart=no \
      --callgrind-out-file="$of" "$build/host-O2/tests/numbers/bench/${program}_instructions" &&
      run_counting "$results/instructions-host-$program" python3 "$root/tests/numbers/bench/callgrind/read.py" "$of.reports" \
        "$of".[0-9]* || return
  done
}

# Counts the instructions of the drivers for CAN controllers on the models of these (tests/drivers/controllers/costs.cpp).
count_drivers() {
  local targets=(lexican_driver_costs) of=$results/callgrind-drivers direction columns=()
  build_preset release || return
  rm -f "$of".[0-9]*
  run_counting "$of.reports" timeout 300 valgrind --quiet --tool=callgrind --compress-strings=no \
    --callgrind-out-file="$of" "$build/release/tests/drivers/controllers/lexican_driver_costs" &&
    run_counting "$of.counts" python3 "$root/tests/numbers/bench/callgrind/read.py" --only '/drivers/can/|fn=CORing' \
      "$of.reports" "$of".[0-9]* || return
  for direction in received sent; do
    sed -n "s/, $direction\t/\t/p" "$of.counts" >"$of-$direction"
    sed -n "s/, $direction\t.*\t/\t/p" "$of.reports" >"$of-$direction-accesses"
    columns+=(--column "$direction, instructions" "$host" "$of-$direction"
      --column "$direction, accesses" "$host" "$of-$direction-accesses")
  done
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/numbers/bench/drivers.txt" \
    --page "$root/docs/speed.md" --table drivers --title controller --percent 3 "${columns[@]}"
}

run_counting() {  # RESULT COMMAND...
  local result=$1
  shift
  "$@" >"$result" 2>&1 || {
    fail "${result##*/}" "$result"
    return 1
  }
}

# Counts the instructions per frame in the committed inputs of the fuzz targets and in sweeps.
count_worst_frame() {
  local of=$results/frame_bound target measured=()
  for target in node sdo_client sdo_server sweep; do
    run_on_machine "$of-$target" "$build/m3/tests/numbers/frame_bound/${target}_frame_bound" || return
    measured+=("$of-$target")
  done
  worst_of "${measured[@]}" >"$of"
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/numbers/frame_bound/bounds.txt" \
    --page "$root/docs/speed.md" --table frame_bound --title frame --remark "the worst" --percent 3 \
    --column "instructions" "$arm" "$of"
}

# Prints the line with the largest number for each name, in the order of the first file.
worst_of() {  # FILE...
  awk -F '\t' '/^#/ { next } !($1 in most) { names[++number] = $1 } $2 > most[$1] + 0 { most[$1] = $2; line[$1] = $0 }
    END { for (n = 1; n <= number; ++n) print line[names[n]] }' "$@"
}
