# SPDX-License-Identifier: Apache-2.0
about="codict linked statically: it runs without shared libraries"
minutes=3
packages=("${build_packages[@]}" "${tool_packages[@]}")

lane() {
  local source=tools/codict targets=(codict)
  build_tree codict-static -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-g0 -O0" -DLEXICAN_STATIC=ON || return
  run_tap "$root/tools/codict/tests/static_test.sh" "$build/codict-static/codict" "$root/tools/codict/tests/fixtures"
}
