# SPDX-License-Identifier: Apache-2.0
about="demo/stm32: a node for three boards with an STM32 compiles without a warning and fits their memories; demo/memory"
minutes=1
packages=("${build_packages[@]}" "${arm_packages[@]}" make python3 qemu-system-arm)

lane() {
  run_pages
  local source=demo/stm32
  build_tree stm32-nucleo_f446re --toolchain "$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_PRESET=slave \
    -DLEXICAN_CPU=cortex-m4 -DLEXICAN_BOARD=nucleo_f446re && pass &&
    check "an oscillator that does not start: the LED blinks" blinks_without_oscillator "$build/stm32-nucleo_f446re/node.elf"
  compile_memory flash_stm32 cortex-m4 flash_pages
  compile_memory flash_stm32h7 cortex-m7 flash_pages
  compile_memory eeprom_i2c_pins cortex-m0 flash_pages eeprom_i2c eeprom_spi
  compile_memory eeprom_spi_pins cortex-m0 flash_pages eeprom_i2c eeprom_spi
  compile_memory node cortex-m0
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
