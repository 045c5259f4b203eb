# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="the cases of lane target on an emulated Cortex-M3, Cortex-M4F (also with doctest), RISC-V and s390x"
. "$root/tests/lanes/boards.sh"
packages=("${board_packages[@]}" "${s390x_packages[@]}")

lane() {
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
