# SPDX-License-Identifier: Apache-2.0
about="the smallest configuration (config/presets/minimal.h) with the library as one file, and the C programs in the configuration slave"
minutes=2
packages=("${build_packages[@]}" python3)

# Builds the smallest configuration for size, so that each preset of CMakePresets.json is used, and the library as one
# file (cmake/one_file.py). The sweeps are reduced: lane clang runs them completely. Lane target runs the doctest cases in
# the configuration slave, on a Cortex-M0.
lane() {
  local targets=(lexican_tests tests/stack/compat/all)
  build_preset size preset-minimal -DLEXICAN_PRESET=minimal -DLEXICAN_ONE_FILE=ON -DLEXICAN_THIN_SWEEPS=ON || return
  run_doctest preset-minimal "$build/preset-minimal/tests/lexican_tests"
  run_ctest preset-minimal-compat "$build/preset-minimal/tests/stack/compat"
  targets=(tests/stack/compat/all)
  build_preset release preset-slave -DLEXICAN_PRESET=slave -DCMAKE_C_FLAGS_RELEASE=-O1 -DCMAKE_CXX_FLAGS_RELEASE=-O1 || return
  run_ctest preset-slave-compat "$build/preset-slave/tests/stack/compat"
}
