# SPDX-License-Identifier: Apache-2.0
about="small C and C++ projects that use the library in every way that is promised, and codict, also for another machine"
packages=("${build_packages[@]}" "${tool_packages[@]}" "${arm_packages[@]}" pkg-config)

lane() {
  build_preset release || return
  run_ctest package "$build/release/tests/package"
}
