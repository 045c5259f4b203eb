# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="all doctest cases without host functions on an emulated Cortex-M0 and big-endian CPU, a smoke test on all boards; --all: on Cortex-M3, M4F, RISC-V and s390x"
minutes=3
packages=("${build_packages[@]}" "${arm_packages[@]}" qemu-system-arm gcc-riscv64-unknown-elf=riscv64-unknown-elf-gcc
  picolibc-riscv64-unknown-elf=/usr/lib/picolibc/riscv64-unknown-elf/picolibc.specs
  qemu-system-misc=qemu-system-riscv32)
packages+=(g++-powerpc-linux-gnu=powerpc-linux-gnu-g++ qemu-user-static=qemu-ppc-static)
[ -z "$all" ] || packages+=(g++-s390x-linux-gnu=s390x-linux-gnu-g++ qemu-user-static=qemu-s390x-static)

# The Cortex-M0 has the configuration slave, the other CPUs full. Runs the code for a Cortex-M0 on a Cortex-M3, which
# has enough memory and, like a Cortex-M0, faults on unaligned accesses.
lane() {
  usual_cores
  [ -z "$all" ] || further_cores
}

usual_cores() {
  arm_tree cortex-m0 -DLEXICAN_PRESET=slave || return
  fault_on cortex-m0 mps2-an385
  on_board cortex-m0 mps2-an385
  local board
  for board in microbit mps2-an385 mps2-an386; do
    smoke_on cortex-m0 "$board"
  done
  cases_of_first=  # slave has fewer cases than full
  linux_tree powerpc && on_linux powerpc qemu-ppc-static
  local targets=(lexican_smoke_virt)
  riscv_tree rv32imac && smoke_on rv32imac virt
}

further_cores() {
  local targets=(all)
  cases_of_first=
  arm_tree cortex-m3 || return
  fault_on cortex-m3 mps2-an385
  on_board cortex-m3 mps2-an385
  arm_tree cortex-m4 -DLEXICAN_FLOAT_ABI=hard || return
  fault_on cortex-m4 mps2-an386
  on_board cortex-m4 mps2-an386
  riscv_tree rv32imac || return
  on_board rv32imac virt
  linux_tree s390x && on_linux s390x qemu-s390x-static
  doctest_tree cortex-m4 -DLEXICAN_FLOAT_ABI=hard || return
  doctest_on_board mps2-an386
}

# Build the tests in build/target-CPU: arm_tree CPU CMAKE-ARGUMENT...
arm_tree() { target_tree "$1" arm-none-eabi "$1" "-mno-unaligned-access" "${@:2}"; }
riscv_tree() { target_tree "$1" riscv32-none-elf "$1" "-mstrict-align" "${@:2}"; }
linux_tree() { target_tree "$1" "$1-linux-gnu" "$1" "" -DLEXICAN_TARGET_TESTS=ON "${@:2}"; }

# Builds the tests in build/target-doctest: doctest_tree CPU CMAKE-ARGUMENT... Unaligned accesses are permitted, as the
# streams of the C++ library use them.
doctest_tree() { target_tree doctest arm-none-eabi "$1" "" -DLEXICAN_TARGET_RUNNER=doctest "${@:2}"; }

target_tree() {  # NAME TOOLCHAIN CPU OPTIONS CMAKE-ARGUMENT...
  build_tree "target-$1" -DLEXICAN_DEMO=OFF -DCMAKE_BUILD_TYPE=MinSizeRel \
    -DCMAKE_C_FLAGS_MINSIZEREL="-Os -DNDEBUG $4" -DCMAKE_CXX_FLAGS_MINSIZEREL="-Os -DNDEBUG $4" -DLEXICAN_CPU="$3" \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$2.cmake" "${@:5}"
}

emulate() {  # BOARD PROGRAM [ARGUMENT...]
  local emulator=(qemu-system-arm -M "$1") argument semihosting=enable=on,target=native,chardev=host,arg=tests
  [ "$1" != virt ] || emulator=(qemu-system-riscv32 -M virt -bios none)
  for argument in "${@:3}"; do
    semihosting+=,arg=${argument//,/,,}
  done
  timeout 600 "${emulator[@]}" -display none -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config "$semihosting" -kernel "$2"
}

# Runs all cases in several processes at the same time, one for each share: suite_on WHAT COMMAND... -- SHARE...
suite_on() {
  local what=$1 log=$results/suite-$1.log command=() share process processes=() status=0
  while shift && [ "$1" != -- ]; do
    command+=("$1")
  done
  rm -f "$log".*
  now "running the cases, $# processes"
  for share in "${@:2}"; do
    "${command[@]}" "$share" >"$log.${#processes[@]}" 2>&1 &
    processes+=($!)
  done
  for process in "${processes[@]}"; do
    wait "$process" || status=$?
  done
  cat "$log".* >"$log"
  count_suite "$what" $status "$log"
}

quarters=(-part=1/4 -part=2/4 -part=3/4 -part=4/4)

# Runs the cases with the small runner. With fewer processes the fragmented heap would exceed the board's memory.
on_board() {  # CPU BOARD
  suite_on "$1" emulate "$2" "$build/target-$1/tests/stack/target/lexican_target_tests" -- "${quarters[@]}"
}

doctest_on_board() {  # BOARD: of doctest_tree
  suite_on doctest emulate "$1" "$build/target-doctest/tests/stack/target/lexican_target_tests" --no-colors -- \
    -sf='*/sdo_*' -sfe='*/sdo_*'
}

on_linux() {  # CPU EMULATOR
  suite_on "$1" "$2" -L "/usr/$1-linux-gnu" "$build/target-$1/tests/stack/target/lexican_target_tests" -- "${quarters[@]}"
}

# Adds up the summaries of the processes. A process reports the cases of the other shares as skipped.
count_suite() {  # WHAT STATUS LOG
  local ran=0 good=0 all=0 line summary='cases: +([0-9]+) \| +([0-9]+) passed \| +([0-9]+) failed \| +([0-9]+) skipped'
  while read -r line; do
    [[ $line =~ $summary ]] || continue
    ran=$((ran + BASH_REMATCH[1])) good=$((good + BASH_REMATCH[2])) all=$((BASH_REMATCH[1] + BASH_REMATCH[4]))
  done < <(grep '^\[doctest\] test cases:' "$3")
  passed=$((passed + good))
  if [ "$ran" -ne "$good" ] || [ "$2" -ne 0 ]; then
    fail "$1: $((ran - good)) cases, status $2" "$3"
  elif [ "$ran" -ne "$all" ] || [ "$ran" -eq 0 ]; then
    fail "$1: $ran of $all cases came back" "$3"
  else
    compare_number "$1" "$ran"
  fi
}

# Checks that each program of a lane runs as many cases as the first one.
compare_number() {  # WHAT CASES
  : "${cases_of_first:=$2}"
  [ "$2" -eq "$cases_of_first" ] || fail "$1 has run $2 cases instead of $cases_of_first"
}

smoke_on() {  # CPU BOARD
  local log=$results/smoke-$2.log ok bad planned
  emulate "$2" "$build/target-$1/tests/stack/target/lexican_smoke_$2" >"$log" 2>&1
  local status=$?
  ok=$(grep -c '^ok ' "$log") bad=$(grep -c '^not ok ' "$log") planned=$(sed -n 's/^1\.\.//p' "$log")
  passed=$((passed + ok))
  if [ $status -ne 0 ] || [ "$bad" -ne 0 ] || [ "$ok" -ne "${planned:-0}" ]; then
    fail "smoke test on $2: $bad cases, status $status" "$log"
  fi
}

# Checks that an unaligned access ends the program by a fault, so that the tests detect such accesses.
fault_on() {  # CPU BOARD
  local log=$results/fault-$1.log
  emulate "$2" "$build/target-$1/tests/stack/target/lexican_fault" >"$log" 2>&1
  if [ $? -eq 99 ]; then pass; else fail "an unaligned access on $1 is no fault" "$log"; fi
}
