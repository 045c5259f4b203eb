# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="all doctest cases without host functions on an emulated Cortex-M0 and big-endian CPU, a smoke test on all boards"
minutes=3
. "$root/tests/lanes/boards.sh"
packages=("${board_packages[@]}" "${powerpc_packages[@]}")

# The Cortex-M0 has the configuration slave, the other CPUs full. Runs the code for a Cortex-M0 on a Cortex-M3, which
# has enough memory and, like a Cortex-M0, faults on unaligned accesses.
lane() {
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
