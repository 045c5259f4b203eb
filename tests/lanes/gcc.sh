# SPDX-License-Identifier: Apache-2.0
about="all doctest cases, small demos and the recipes of docs/cookbook.md, gcc -O2"
minutes=4
packages=("${build_packages[@]}" python3)

# A contributor's run compiles the tests as fast as possible and reduces the sweeps. The full run optimises the tests,
# which run the complete sweeps four times as fast then.
lane() {
  if [ -z "$full" ]; then
    build_preset release release -DLEXICAN_TEST_OPTIONS=-O0 -DLEXICAN_THIN_SWEEPS=ON || return
  else
    build_preset release release -DLEXICAN_TEST_OPTIONS=-O1 -DLEXICAN_THIN_SWEEPS=OFF || return
  fi
  run_doctest gcc "$build/release/tests/lexican_tests"
  run_doctest "gcc models" "$build/release/tests/models/lexican_model_tests"
  run_doctest "gcc controllers" "$build/release/tests/controllers/lexican_controller_tests"
  run_doctest "gcc memories" "$build/release/tests/memories/lexican_memory_tests"
  run_ctest system "$build/release/tests/system"
  run_ctest cookbook "$build/release/tests/cookbook"
}
