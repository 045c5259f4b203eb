# SPDX-License-Identifier: Apache-2.0
about="all doctest cases that need no host on a Cortex-M0, and a smoke test that fits the smallest board on all boards, emulated"
. "$root/tests/lanes/boards.sh"

# The code of a Cortex-M0 runs on a Cortex-M3, which has the memory for it, and faults as on a Cortex-M0.
lane() {
  arm_tree lexican_tests_m0 lexican_smoke_microbit lexican_smoke_mps2-an385 lexican_smoke_mps2-an386 || return
  riscv_tree lexican_smoke_virt || return
  doctest_on mps2-an385 lexican_tests_m0
  local board
  for board in microbit mps2-an385 mps2-an386 virt; do
    smoke_on "$board"
  done
}
