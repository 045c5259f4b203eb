# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with complete sweeps, and the C programs, clang, PDOs that map single bits"
minutes=4
packages=("${build_packages[@]}" python3 clang lld=ld.lld)

lane() {
  local targets=(lexican_tests tests/stack/compat/all)
  build_tree clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_C_FLAGS=-DUSE_PDO_BITS=1 -DCMAKE_CXX_FLAGS=-DUSE_PDO_BITS=1 \
    -DCMAKE_C_FLAGS_RELEASE="-O1 -DNDEBUG" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" || return
  run_doctest clang "$build/clang/tests/lexican_tests"
  run_ctest clang-compat "$build/clang/tests/stack/compat"
}
