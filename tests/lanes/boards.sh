# SPDX-License-Identifier: Apache-2.0
about="nodes on an STM32, a ZynqMP and a SABRE Lite (its QEMU 11 is not in the distribution), with the driver check"
minutes=3
packages=("${build_packages[@]}" "${arm_packages[@]}" make python3 qemu-system-arm
  gcc-aarch64-linux-gnu=aarch64-linux-gnu-gcc g++-aarch64-linux-gnu=aarch64-linux-gnu-g++ qemu-system-arm=qemu-system-aarch64)

lane() {
  run_pages
  stm32
  zynqmp
  sabrelite
}

# demo/stm32 compiles without a warning and fits the memories; demo/memory

stm32() {
  check "the firmware of docs/hardware.md for nucleo_f446re" other_board nucleo_f446re &&
    check "an oscillator that does not start: the LED blinks" blinks_without_oscillator "$copy/../firmware/build/node.elf"
  compile_memory flash_stm32 cortex-m4 flash_pages
  compile_memory flash_stm32h7 cortex-m7 flash_pages
  compile_memory eeprom_i2c_pins cortex-m0 flash_pages eeprom_i2c eeprom_spi
  compile_memory eeprom_spi_pins cortex-m0 flash_pages eeprom_i2c eeprom_spi
  compile_memory node cortex-m0
}

# Builds the firmware of the pages for another board with the same CPU.
other_board() {  # BOARD
  cmake -D LEXICAN_BOARD="$1" "$copy/../firmware/build" && cmake --build "$copy/../firmware/build"
}

# Runs the firmware of nucleo_f446re on QEMU's STM32F405, which has no RCC: GPIOA_BSRR sets and resets PA5.
blinks_without_oscillator() {  # FIRMWARE
  local said=$results/stm32-blinks.log
  qemu-system-arm -M netduinoplus2 -nographic -monitor none -serial none -kernel "$1" -d unimp -D "$said" &
  local emulator=$! tries=600
  until has_blinked "$said" || [ $((tries -= 1)) -eq 0 ]; do sleep 0.1; done
  kill $emulator
  has_blinked "$said"
}

has_blinked() { grep -q 'GPIOA.*write.*0x018, value 0x00000020' "$1" && grep -q 'GPIOA.*write.*0x018, value 0x00200000' "$1"; }

compile_memory() {  # SOURCE CPU DRIVER...
  local driver drivers=()
  for driver in "${@:3}"; do drivers+=(-I "$root/drivers/nvm/$driver"); done
  check "demo/memory/$1.c is compiled for $2" arm-none-eabi-gcc -mcpu="$2" -mthumb -std=c11 -Os -pedantic -Wall -Wextra \
    -Wconversion -Wsign-conversion -Wshadow -Wundef -Wstrict-prototypes -Wcast-align -Werror -I "$root/include" \
    -I "$root/config" "${drivers[@]}" -c "$root/demo/memory/$1.c" -o /dev/null
}

# A node and its master on the CAN controllers of an emulated ZynqMP

zynqmp() {
  local source=tests/drivers/zynqmp
  build_tree zynqmp -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/aarch64-bare.cmake" || return
  run_on_zynqmp lexican_zynqmp
  run_on_zynqmp lexican_zynqmp_driver_check
}

run_on_zynqmp() {  # PROGRAM
  run_tap timeout 1200 qemu-system-aarch64 -M xlnx-zcu102,canbus0=bus,canbus1=bus -object can-bus,id=bus -m 256M \
    -display none -audiodev none,id=none -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config enable=on,target=native,chardev=host -icount shift=4,sleep=off -kernel "$build/zynqmp/$1"
}

# demo/sabrelite: a device and its master on the FlexCAN controllers

# LEXICAN_QEMU_ARM names another QEMU: the controllers exist since QEMU 11, which the distribution does not have.
sabrelite() {
  local qemu=${LEXICAN_QEMU_ARM:-qemu-system-arm} version
  version=$("$qemu" --version | grep -oE 'version [0-9]+' | cut -d' ' -f2)
  if [ "${version:-0}" -lt 11 ]; then
    skip "QEMU ${version:-} has no FlexCAN: set LEXICAN_QEMU_ARM to QEMU 11 or later"
    return
  fi
  run_on_sabrelite nodes
  run_on_sabrelite driver_check
}

# Runs are the same on every host, as each instruction takes the same time on the clock of the emulated machine.
run_on_sabrelite() {  # PROGRAM
  run_tap timeout 1200 "$qemu" -M sabrelite,canbus0=bus,canbus1=bus -object can-bus,id=bus -m 256M -display none \
    -monitor none -serial null -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host \
    -icount shift=4,sleep=off -kernel "$copy/build/sabrelite/$1.elf"
}
