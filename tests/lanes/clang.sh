# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with complete sweeps, the C programs and the recipes, clang"
minutes=4
packages=("${build_packages[@]}" python3 clang lld=ld.lld)

lane() {
  local targets=(lexican_tests lexican_model_tests lexican_controller_tests lexican_memory_tests tests/compat/all tests/cookbook/all)
  build_tree clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_C_FLAGS_RELEASE="-O1 -DNDEBUG" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" || return
  run_doctest clang "$build/clang/tests/lexican_tests"
  run_doctest "clang models" "$build/clang/tests/models/lexican_model_tests"
  run_doctest "clang controllers" "$build/clang/tests/controllers/lexican_controller_tests"
  run_doctest "clang memories" "$build/clang/tests/memories/lexican_memory_tests"
  run_ctest clang-compat "$build/clang/tests/compat"
  run_ctest clang-cookbook "$build/clang/tests/cookbook"
}
