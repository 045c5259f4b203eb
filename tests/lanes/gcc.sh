# SPDX-License-Identifier: Apache-2.0
about="all doctest cases, small demos and the recipes of docs/cookbook.md, gcc -O2"
minutes=4
packages=("${build_packages[@]}" python3)

lane() {
  build_preset release || return
  run_doctest gcc "$build/release/tests/lexican_tests"
  run_ctest system "$build/release/tests/system"
  run_ctest cookbook "$build/release/tests/cookbook"
}
