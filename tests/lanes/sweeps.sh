# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with complete sweeps, clang with address and undefined behaviour sanitizers"
packages=("${build_packages[@]}" "${clang_packages[@]}")

lane() {
  local targets=(lexican_tests)
  build_preset development sweeps || return
  run_doctest sweeps "$build/sweeps/tests/lexican_tests"
}
