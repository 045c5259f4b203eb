# SPDX-License-Identifier: Apache-2.0
about="all doctest cases and the C programs, clang with address and undefined behaviour sanitizers"
minutes=6
packages=("${build_packages[@]}" python3 "${clang_packages[@]}")

# Reduces the sweeps: lane gcc runs them completely, lane sweeps with sanitizers. The tests themselves are compiled
# without the sanitizer for undefined behaviour, which takes time.
lane() {
  local targets=(lexican_tests lexican_model_tests lexican_controller_tests lexican_memory_tests tests/compat/all tests/cookbook/all)
  build_preset development clang -DLEXICAN_THIN_SWEEPS=ON -DLEXICAN_TEST_OPTIONS="-O0;-g1;-fno-sanitize=undefined" || return
  run_doctest clang "$build/clang/tests/lexican_tests"
  run_doctest "clang models" "$build/clang/tests/models/lexican_model_tests"
  run_doctest "clang controllers" "$build/clang/tests/controllers/lexican_controller_tests"
  run_doctest "clang memories" "$build/clang/tests/memories/lexican_memory_tests"
  run_ctest clang-compat "$build/clang/tests/compat"
  run_ctest clang-cookbook "$build/clang/tests/cookbook"
}
