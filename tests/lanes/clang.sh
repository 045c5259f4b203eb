# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with complete sweeps, and the C programs, clang, PDOs that map single bits"
minutes=4
packages=("${build_packages[@]}" python3 clang lld=ld.lld)

lane() {
  local targets=(lexican_tests tests/compat/all)
  local flags="-O1 -DNDEBUG -DUSE_PDO_BITS=1"
  build_tree clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_C_FLAGS_RELEASE="$flags" -DCMAKE_CXX_FLAGS_RELEASE="$flags" || return
  run_doctest clang "$build/clang/tests/lexican_tests"
  run_ctest clang-compat "$build/clang/tests/compat"
}
