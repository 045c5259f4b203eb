# SPDX-License-Identifier: Apache-2.0
about="all doctest cases, the C programs, small demos and recipes, gcc${full:+ with address and undefined behaviour sanitizers, and the fuzz inputs of the stack}"
minutes=${full:+5}
: "${minutes:=3}"
. "$root/tests/fuzz/build.sh"
packages=("${build_packages[@]}" python3)

lane() {
  local tree=release target
  if [ -n "$full" ]; then
    tree=gcc
    local targets=(all "${stack_fuzz_targets[@]/%/_fuzz}")
    sanitized_tree || return
  else
    build_preset release release -DLEXICAN_THIN_SWEEPS=ON || return
  fi
  run_doctest gcc "$build/$tree/tests/lexican_tests"
  run_doctest "gcc models" "$build/$tree/tests/drivers/models/lexican_model_tests"
  run_doctest "gcc controllers" "$build/$tree/tests/drivers/controllers/lexican_controller_tests"
  run_doctest "gcc memories" "$build/$tree/tests/drivers/memories/lexican_memory_tests"
  built_from "$tree" tests/stack tests/drivers/{unit,controllers,memories,models} tests/programs -name '*_test.cpp'
  run_ctest system "$build/$tree/tests/programs/commands"
  run_ctest cookbook "$build/$tree/tests/stack/cookbook"
  run_ctest compat "$build/$tree/tests/stack/compat"
  built_from "$tree" tests/stack/{cookbook,compat} -name '*.c*' -not -name other_configuration.c  # compiled by a case of ctest
  [ -n "$full" ] || return 0
  for target in "${stack_fuzz_targets[@]}"; do
    check "$target" "$build/gcc/tests/fuzz/${target}_fuzz" "$root/tests/fuzz/inputs/$target.txt"
  done
}
