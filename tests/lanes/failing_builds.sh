# SPDX-License-Identifier: Apache-2.0
about="sources that gcc, clang and arm-none-eabi-gcc must reject with the expected message"
minutes=1
packages=("${build_packages[@]}" clang "${arm_packages[@]}")

lane() {
  local targets=(lexican)
  build_preset release || return
  run_ctest failing_builds "$build/release/tests/stack/failing_builds"
}
