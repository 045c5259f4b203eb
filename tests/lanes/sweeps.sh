# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with complete sweeps, and the C programs, clang with address and undefined behaviour sanitizers"
packages=("${build_packages[@]}" "${clang_packages[@]}")

lane() {
  local targets=(lexican_tests lexican_model_tests lexican_controller_tests lexican_memory_tests tests/stack/compat/all tests/stack/cookbook/all)
  build_preset development sweeps || return
  run_doctest sweeps "$build/sweeps/tests/lexican_tests"
  run_doctest "sweeps models" "$build/sweeps/tests/drivers/models/lexican_model_tests"
  run_doctest "sweeps controllers" "$build/sweeps/tests/drivers/controllers/lexican_controller_tests"
  run_doctest "sweeps memories" "$build/sweeps/tests/drivers/memories/lexican_memory_tests"
  run_ctest sweeps-compat "$build/sweeps/tests/stack/compat"
  run_ctest sweeps-cookbook "$build/sweeps/tests/stack/cookbook"
}
