# SPDX-License-Identifier: Apache-2.0
about="tests with threads and the thread sanitizer: a ring with a writing and a reading thread, a node with two threads"
minutes=2
packages=("${build_packages[@]}" "${clang_packages[@]}")

# Runs without address randomisation: the sanitizer's shadow memory needs fixed addresses, which newer kernels may use.
lane() {
  local targets=(lexican_thread_tests lexican-demo-two-threads lexican-demo-without-node-lock)
  build_tree threads -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang \
    -DCMAKE_CXX_COMPILER=clang++ -DLEXICAN_SANITIZE=thread || return
  run_doctest threads setarch -R "$build/threads/tests/lexican_thread_tests"
  local demo=$build/threads/demo/two_threads
  check "two threads use a node in turns" timeout 1200 setarch -R "$demo/lexican-demo-two-threads"
  check "the sanitizer finds races where turns are missing" finds_races "$demo/lexican-demo-without-node-lock"
}
