# SPDX-License-Identifier: Apache-2.0
about="programs against the public API, as C11 and as C++17"
minutes=1
packages=("${build_packages[@]}")

lane() {
  build_preset release || return
  run_ctest compat "$build/release/tests/compat"
}
