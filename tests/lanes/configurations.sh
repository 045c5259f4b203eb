# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with other ways to compile: -O3, link-time optimisation, unsigned char, asserts on"
packages=("${build_packages[@]}")

lane() {
  configuration O3 -O3
  configuration lto "-O2 -flto"
  configuration unsigned-char "-O2 -funsigned-char"
  configuration short-enums "-O2 -fshort-enums"
  configuration asserts "-O0 -UNDEBUG"
}

configuration() {  # NAME FLAGS
  build_tree "configuration-$1" -DLEXICAN_WARNINGS_AS_ERRORS=ON -DCMAKE_C_FLAGS="$2" -DCMAKE_CXX_FLAGS="$2" || return
  run_doctest "$1" "$build/configuration-$1/tests/lexican_tests"
}
