# SPDX-License-Identifier: Apache-2.0
about="the fuzz targets of the stack with their committed inputs, gcc and clang with address and undefined behaviour sanitizers"
minutes=3
packages=("${build_packages[@]}" "${clang_packages[@]}" "${tool_packages[@]}")
. "$root/tests/fuzz/build.sh"

# Runs the stack's targets only: lane codict, which builds the tools, runs those of the tools.
lane() {
  local fuzz_targets=("${stack_fuzz_targets[@]}")
  corpus_of gcc g++
  corpus_of clang clang++
}

corpus_of() {  # COMPILER C++-COMPILER
  build_fuzz "fuzz-corpus-$1" "$1" "$2" address,undefined || return
  local target
  for target in "${fuzz_targets[@]}"; do
    check "$target, $1" "$build/fuzz-corpus-$1/tests/fuzz/${target}_fuzz" "$root/tests/fuzz/corpus/$target"
  done
}
