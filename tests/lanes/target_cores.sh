# SPDX-License-Identifier: Apache-2.0
about="the doctest cases of the lane target with the code of a Cortex-M3, a Cortex-M4F and a RISC-V, emulated"
. "$root/tests/lanes/boards.sh"

lane() {
  arm_tree lexican_tests_m3 lexican_tests_m4f || return
  riscv_tree lexican_tests_rv32 || return
  doctest_on mps2-an385 lexican_tests_m3
  doctest_on mps2-an386 lexican_tests_m4f
  small_on virt lexican_tests_rv32
}
