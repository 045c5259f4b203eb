# SPDX-License-Identifier: Apache-2.0
about="a node and its master on the CAN controllers of a ZynqMP (emulated), without an operating system; the driver check"
minutes=1
packages=(cmake ninja-build=ninja gcc-aarch64-linux-gnu=aarch64-linux-gnu-gcc g++-aarch64-linux-gnu=aarch64-linux-gnu-g++
  qemu-system-arm=qemu-system-aarch64)

lane() {
  local source=tests/drivers/zynqmp
  build_tree zynqmp -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/aarch64-bare.cmake" || return
  run_on_machine lexican_zynqmp
  run_on_machine lexican_zynqmp_driver_check
}

# Runs are the same on every host, as each instruction takes the same time on the clock of the emulated machine.
run_on_machine() {  # PROGRAM
  run_tap timeout 1200 qemu-system-aarch64 -M xlnx-zcu102,canbus0=bus,canbus1=bus -object can-bus,id=bus -m 256M \
    -display none -audiodev none,id=none -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config enable=on,target=native,chardev=host -icount shift=4,sleep=off -kernel "$build/zynqmp/$1"
}
