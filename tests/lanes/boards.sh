# SPDX-License-Identifier: Apache-2.0
# For the lanes that run tests/target on boards of QEMU (demo/bare_metal/boards). Their programs must all run the same
# number of cases.
packages=("${build_packages[@]}" "${arm_packages[@]}" qemu-system-arm gcc-riscv64-unknown-elf=riscv64-unknown-elf-gcc
  picolibc-riscv64-unknown-elf=/usr/lib/picolibc/riscv64-unknown-elf/picolibc.specs
  qemu-system-misc=qemu-system-riscv32)

arm_tree() { board_tree arm arm-none-eabi cortex-m0 "$@"; }
riscv_tree() { board_tree riscv riscv32-none-elf rv32imac "$@"; }

board_tree() {  # NAME TOOLCHAIN CPU TARGET...
  local tree=$build/target-$1 log=$results/build-target-$1.log
  if ! { cmake -S "$root" -B "$tree" -G Ninja -DLEXICAN_PRESET=full -DLEXICAN_DEMO=OFF -DLEXICAN_WARNINGS_AS_ERRORS=ON \
    -DCMAKE_BUILD_TYPE=MinSizeRel -DLEXICAN_CPU="$3" \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$2.cmake" && cmake --build "$tree" --target "${@:4}"; } >"$log" 2>&1; then
    fail "build for $1" "$log"
    return 1
  fi
}

emulate() {  # BOARD PROGRAM [ARGUMENT...]
  local emulator=(qemu-system-arm -M "$1") argument semihosting=enable=on,target=native,chardev=host,arg=tests
  [ "$1" != virt ] || emulator=(qemu-system-riscv32 -M virt -bios none)
  for argument in "${@:3}"; do
    semihosting+=,arg=${argument//,/,,}
  done
  timeout 900 "${emulator[@]}" -display none -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config "$semihosting" -kernel "$2"
}

# In two processes at the same time, which have half of the work each.
doctest_on() {  # BOARD PROGRAM
  local log=$results/$2 files='*/sdo_*'
  emulate "$1" "$build/target-arm/tests/target/$2" --no-colors -sf="$files" >"$log-1.log" 2>&1 &
  emulate "$1" "$build/target-arm/tests/target/$2" --no-colors -sfe="$files" >"$log-2.log" 2>&1
  local status=$?
  wait $! || status=$?
  cat "$log-1.log" "$log-2.log" >"$log.log"
  count_on "$2" "$status" "$log.log"
}

small_on() {  # BOARD PROGRAM: with the small runner
  local log=$results/$2.log
  emulate "$1" "$build/target-riscv/tests/target/$2" >"$log" 2>&1
  count_on "$2" $? "$log"
}

# Adds up the summaries of a program's processes. Each says how many cases it has not run: these are the other's.
count_on() {  # PROGRAM STATUS LOG
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
  elif [ "${cases:=$ran}" -ne "$ran" ]; then
    fail "$1 has run $ran cases, and the programs before it $cases"
  fi
}

smoke_on() {  # BOARD
  local log=$results/smoke-$1.log tree=$build/target-arm ok bad planned
  [ "$1" != virt ] || tree=$build/target-riscv
  emulate "$1" "$tree/tests/target/lexican_smoke_$1" >"$log" 2>&1
  local status=$?
  ok=$(grep -c '^ok ' "$log") bad=$(grep -c '^not ok ' "$log") planned=$(sed -n 's/^1\.\.//p' "$log")
  passed=$((passed + ok))
  if [ $status -ne 0 ] || [ "$bad" -ne 0 ] || [ "$ok" -ne "${planned:-0}" ]; then
    fail "smoke test on $1: $bad cases, status $status" "$log"
  fi
}
