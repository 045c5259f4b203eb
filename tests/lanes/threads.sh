# SPDX-License-Identifier: Apache-2.0
about="all doctest cases under the thread sanitizer: interrupt ends of queues and timers"
packages=("${build_packages[@]}" "${clang_packages[@]}")

# Without address randomisation: the sanitizer's shadow needs its fixed place, which newer kernels may give away.
lane() {
  build_tree threads -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DLEXICAN_SANITIZE=thread || return
  run_doctest threads setarch -R "$build/threads/tests/lexican_tests"
}
