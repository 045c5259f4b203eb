# SPDX-License-Identifier: Apache-2.0
about="sources that must be refused, with the right message, by gcc, clang and arm-none-eabi-gcc"
minutes=1
packages=("${build_packages[@]}" clang "${arm_packages[@]}")

lane() {
  build_preset release || return
  run_ctest failing_builds "$build/release/tests/failing_builds"
}
