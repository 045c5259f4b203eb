# SPDX-License-Identifier: Apache-2.0
about="all doctest cases and the C programs, clang with address and undefined behaviour sanitizers"
packages=("${build_packages[@]}" "${clang_packages[@]}")

lane() {
  build_preset development || return
  run_doctest clang "$build/development/tests/lexican_tests"
  run_ctest clang-compat "$build/development/tests/compat"
}
