# SPDX-License-Identifier: Apache-2.0
about="demo/stm32: a node for three boards with an STM32 compiles without a warning and fits their memories; demo/memory"
minutes=1
packages=("${build_packages[@]}" "${arm_packages[@]}" make python3)

lane() {
  run_pages
  local source=demo/stm32
  build_tree stm32-nucleo_f446re --toolchain "$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_PRESET=slave \
    -DLEXICAN_CPU=cortex-m4 -DLEXICAN_BOARD=nucleo_f446re && pass
  compile_memory flash_stm32f4 cortex-m4 flash_pages
  compile_memory flash_stm32g4 cortex-m4 flash_pages
  compile_memory flash_stm32h7 cortex-m7 flash_pages
  compile_memory eeprom_i2c_pins cortex-m0 flash_pages eeprom_i2c eeprom_spi
  compile_memory eeprom_spi_pins cortex-m0 flash_pages eeprom_i2c eeprom_spi
  compile_memory node cortex-m0
}

compile_memory() {  # SOURCE CPU DRIVER...
  local driver drivers=()
  for driver in "${@:3}"; do drivers+=(-I "$root/drivers/nvm/$driver"); done
  check "demo/memory/$1.c is compiled for $2" arm-none-eabi-gcc -mcpu="$2" -mthumb -std=c11 -Os -pedantic -Wall -Wextra \
    -Wconversion -Wsign-conversion -Wshadow -Wundef -Wstrict-prototypes -Wcast-align -Werror -I "$root/include" \
    -I "$root/config" "${drivers[@]}" -c "$root/demo/memory/$1.c" -o /dev/null
}
