# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with complete sweeps, and the C programs, clang, PDOs that map single bits; --all: also with sanitizers"
minutes=4
packages=("${build_packages[@]}" "${clang_packages[@]}" python3 lld=ld.lld)

lane() {
  optimised
  [ -z "$all" ] || with_sanitizers
}

optimised() {
  local targets=(lexican_tests tests/stack/compat/all)
  build_tree clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_C_FLAGS=-DUSE_PDO_BITS=1 -DCMAKE_CXX_FLAGS=-DUSE_PDO_BITS=1 \
    -DCMAKE_C_FLAGS_RELEASE="-O1 -DNDEBUG" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" || return
  run_doctest clang "$build/clang/tests/lexican_tests"
  run_ctest clang-compat "$build/clang/tests/stack/compat"
}

with_sanitizers() {
  local targets=(lexican_tests lexican_model_tests lexican_controller_tests lexican_memory_tests tests/stack/compat/all tests/stack/cookbook/all)
  build_preset development clang-sanitized || return
  run_doctest clang-sanitized "$build/clang-sanitized/tests/lexican_tests"
  run_doctest "clang-sanitized models" "$build/clang-sanitized/tests/drivers/models/lexican_model_tests"
  run_doctest "clang-sanitized controllers" "$build/clang-sanitized/tests/drivers/controllers/lexican_controller_tests"
  run_doctest "clang-sanitized memories" "$build/clang-sanitized/tests/drivers/memories/lexican_memory_tests"
  run_ctest clang-sanitized-compat "$build/clang-sanitized/tests/stack/compat"
  run_ctest clang-sanitized-cookbook "$build/clang-sanitized/tests/stack/cookbook"
}
