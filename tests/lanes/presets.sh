# SPDX-License-Identifier: Apache-2.0
about="the configurations of config/presets (all other lanes use full)"
minutes=4
packages=("${build_packages[@]}")

# Builds the smallest configuration for size, so that each preset of CMakePresets.json is used. The sweeps are reduced:
# lane gcc runs them completely.
lane() {
  test_preset size minimal
  test_preset release slave
}

test_preset() {  # CMAKE-PRESET CONFIGURATION
  local targets=(lexican_tests tests/compat/all)
  build_preset "$1" "preset-$2" -DLEXICAN_PRESET="$2" -DLEXICAN_THIN_SWEEPS=ON || return
  run_doctest "preset-$2" "$build/preset-$2/tests/lexican_tests"
  run_ctest "preset-$2-compat" "$build/preset-$2/tests/compat"
}
