# SPDX-License-Identifier: Apache-2.0
about="demo/stm32: a node for three boards with an STM32 compiles without a warning and fits their memories; demo/memory"
minutes=1
packages=("${build_packages[@]}" "${arm_packages[@]}")

lane() {
  build_for bluepill cortex-m3
  build_for nucleo_f446re cortex-m4
  build_for nucleo_g474re cortex-m4  # shares the build tree of nucleo_f446re
  compile_memory flash_stm32f4 cortex-m4
  compile_memory flash_stm32g4 cortex-m4
  compile_memory flash_stm32h7 cortex-m7
  compile_memory eeprom_i2c_pins cortex-m0
  compile_memory eeprom_spi_pins cortex-m0
  compile_memory node cortex-m0
}

compile_memory() {  # SOURCE CPU
  check "demo/memory/$1.c is compiled for $2" arm-none-eabi-gcc -mcpu="$2" -mthumb -std=c11 -Os -pedantic -Wall -Wextra \
    -Wconversion -Wsign-conversion -Wshadow -Wundef -Wstrict-prototypes -Wcast-align -Werror -I "$root/include" \
    -I "$root/config" -I "$root/drivers/nvm/flash_pages" -I "$root/drivers/nvm/eeprom_i2c" \
    -I "$root/drivers/nvm/eeprom_spi" -c "$root/demo/memory/$1.c" -o /dev/null
}

build_for() {  # BOARD CPU
  local source=demo/stm32
  build_tree "stm32-$2" --toolchain "$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_PRESET=slave -DLEXICAN_CPU="$2" \
    -DLEXICAN_BOARD="$1" && pass
}
