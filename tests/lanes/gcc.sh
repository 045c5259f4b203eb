# SPDX-License-Identifier: Apache-2.0
about="all doctest cases and small demos, gcc -O2"
packages=("${build_packages[@]}")

lane() {
  build_preset release || return
  run_doctest gcc "$build/release/tests/lexican_tests"
  run_ctest system "$build/release/tests/system"
}
