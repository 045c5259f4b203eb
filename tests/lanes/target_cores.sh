# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="the cases of the lane target on a Cortex-M3, a Cortex-M4F (by doctest itself, too), a RISC-V and an s390x, emulated"
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
