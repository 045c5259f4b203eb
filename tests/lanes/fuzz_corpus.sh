# SPDX-License-Identifier: Apache-2.0
about="the fuzz targets of the stack with their committed inputs, clang with address and undefined behaviour sanitizers"
minutes=1
packages=("${build_packages[@]}" "${clang_packages[@]}" "${tool_packages[@]}")
. "$root/tests/fuzz/build.sh"

# Runs the stack's targets only: lane codict, which builds the tools, runs those of the tools, compiled by gcc.
lane() {
  local fuzz_targets=("${stack_fuzz_targets[@]}") target
  build_fuzz fuzz-corpus clang clang++ address,undefined || return
  for target in "${fuzz_targets[@]}"; do
    check "$target" "$build/fuzz-corpus/tests/fuzz/${target}_fuzz" "$root/tests/fuzz/corpus/$target"
  done
}
