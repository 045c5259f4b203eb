# SPDX-License-Identifier: Apache-2.0
about="demo/stm32: a node for three boards with an STM32 compiles without a warning and fits their memories"
minutes=1
packages=("${build_packages[@]}" "${arm_packages[@]}")

lane() {
  build_for bluepill cortex-m3
  build_for nucleo_f446re cortex-m4
  build_for nucleo_g474re cortex-m4
}

build_for() {  # BOARD CPU
  check "a node for the $1 is built" builds "$1" "$2"
}

builds() {  # BOARD CPU
  local tree=$build/stm32-$1
  cmake -S "$root/demo/stm32" -B "$tree" -G Ninja --toolchain "$root/cmake/toolchains/arm-none-eabi.cmake" \
    -D LEXICAN_CPU="$2" -D LEXICAN_BOARD="$1" -D LEXICAN_WARNINGS_AS_ERRORS=ON && cmake --build "$tree"
}
