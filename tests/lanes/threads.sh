# SPDX-License-Identifier: Apache-2.0
about="tests with threads and the thread sanitizer: a ring with a writing and a reading thread, a node with two threads, the FreeRTOS example"
minutes=1
packages=("${build_packages[@]}" "${clang_packages[@]}" "${arm_packages[@]}")

# Runs without address randomisation: the sanitizer's shadow memory needs fixed addresses, which newer kernels may use.
lane() {
  local targets=(lexican_thread_tests lexican-demo-two-threads lexican-demo-without-node-lock rtos_example rtos_without_lock)
  build_tree threads -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang \
    -DCMAKE_CXX_COMPILER=clang++ -DLEXICAN_SANITIZE=thread || return
  run_doctest threads setarch -R "$build/threads/tests/lexican_thread_tests"
  local demo=$build/threads/demo/two_threads rtos=$build/threads/tests/programs/rtos
  check "two threads use a node in turns" timeout 1200 setarch -R "$demo/lexican-demo-two-threads"
  check "the sanitizer finds races where turns are missing" finds_races "$demo/lexican-demo-without-node-lock"
  run_tap setarch -R "$rtos/rtos_example"
  check "the sanitizer finds races where the lock of the FreeRTOS example is missing" finds_races "$rtos/rtos_without_lock"
  check "the FreeRTOS example is compiled for Cortex-M4" compiles_for_arm
}

compiles_for_arm() {
  local source
  for source in node_task sdo_request; do
    arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -Os -std=c11 -Wall -Wextra -Wconversion -Wshadow -Wcast-align -Werror \
      -DCO_CFG_PRESET='"presets/full.h"' -I "$root/include" -I "$root/config" -I "$root/tests/programs/rtos/stub" \
      -c "$root/tests/programs/rtos/$source.c" -o "$results/$source.o" || return
  done
}

# Succeeds if the thread sanitizer detects a data race in a program without locks.
finds_races() {  # PROGRAM
  local said
  said=$(TSAN_OPTIONS=halt_on_error=1 timeout 1200 setarch -R "$1" 2>&1)
  grep 'WARNING: ThreadSanitizer: data race' <<<"$said"
}
