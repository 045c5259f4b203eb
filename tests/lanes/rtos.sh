# SPDX-License-Identifier: Apache-2.0
about="the FreeRTOS example on threads with the thread sanitizer: a master reads a device"
minutes=1
packages=("${build_packages[@]}" "${clang_packages[@]}" "${arm_packages[@]}")

# Runs without address randomisation for the reason given in lane threads.
lane() {
  local tree=$build/rtos log=$results/build-rtos.log
  { cmake -S "$root/tests/rtos" -B "$tree" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang \
    -DCMAKE_CXX_COMPILER=clang++ -DLEXICAN_WARNINGS_AS_ERRORS=ON -DLEXICAN_SANITIZE=thread &&
    cmake --build "$tree" --target rtos_example rtos_without_lock; } >"$log" 2>&1 || { fail "build of rtos" "$log"; return; }
  run_tap setarch -R "$tree/rtos_example"
  check "the sanitizer finds races where the lock is missing" finds_races "$tree/rtos_without_lock"
  check "the example is compiled for Cortex-M4" compiles_for_arm
}

compiles_for_arm() {
  local source
  for source in node_task sdo_request; do
    arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -Os -std=c11 -Wall -Wextra -Wconversion -Wshadow -Wcast-align -Werror \
      -DCO_CFG_PRESET='"presets/full.h"' -I "$root/include" -I "$root/config" -I "$root/tests/rtos/stub" \
      -c "$root/tests/rtos/$source.c" -o "$results/$source.o" || return
  done
}
