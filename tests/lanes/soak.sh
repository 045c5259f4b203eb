# SPDX-License-Identifier: Apache-2.0
about="the soak test with LEXICAN_SOAK_MINUTES (60) of simulated time, gcc -O2"
packages=("${build_packages[@]}")

lane() {
  build_preset release || return
  LEXICAN_SOAK_MINUTES=${LEXICAN_SOAK_MINUTES:-60} run_doctest soak "$build/release/tests/lexican_tests" -tc='soak:*'
}
