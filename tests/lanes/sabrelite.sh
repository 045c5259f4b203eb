# SPDX-License-Identifier: Apache-2.0
about="demo/sabrelite: a device and its master on the FlexCAN controllers of a SABRE Lite, and the driver check; run in QEMU 11"
minutes=2
packages=("${build_packages[@]}" "${arm_packages[@]}" qemu-system-arm=qemu-system-arm python3)

# LEXICAN_QEMU_ARM names another QEMU: the controllers exist since QEMU 11, which the distribution does not have.
lane() {
  local qemu=${LEXICAN_QEMU_ARM:-qemu-system-arm} version
  run_pages
  version=$("$qemu" --version | grep -oE 'version [0-9]+' | cut -d' ' -f2)
  if [ "${version:-0}" -lt 11 ]; then
    skip "QEMU ${version:-} has no FlexCAN: set LEXICAN_QEMU_ARM to QEMU 11 or later"
    return
  fi
  run_on_machine nodes
  run_on_machine driver_check
}

# Runs are the same on every host, as each instruction takes the same time on the clock of the emulated machine.
run_on_machine() {  # PROGRAM
  run_tap timeout 1200 "$qemu" -M sabrelite,canbus0=bus,canbus1=bus -object can-bus,id=bus -m 256M -display none \
    -monitor none -serial null -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host \
    -icount shift=4,sleep=off -kernel "$copy/build/sabrelite/$1.elf"
}
