# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with each further compiler of the distribution, the newest also as C++20"
packages=("${build_packages[@]}")

lane() {
  local version
  for version in g++-11 clang-13 clang-15 clang-16 clang-19; do
    with_compiler "$version" 17
  done
  with_compiler g++-12 20
  with_compiler clang-19 20
}

with_compiler() {  # PACKAGE STANDARD
  local package=$1 c=${1/g++/gcc} cxx=${1/clang/clang++} targets=(lexican_tests)
  if ! install_packages "$package=$cxx"; then
    skip "$package, C++$2: not available"
    return
  fi
  build_tree "compiler-$package-$2" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_STANDARD="$2" \
    -DLEXICAN_THIN_SWEEPS=ON -DCMAKE_C_COMPILER="$c" -DCMAKE_CXX_COMPILER="$cxx" || return
  run_doctest "$package-c++$2" "$build/compiler-$package-$2/tests/lexican_tests"
}
