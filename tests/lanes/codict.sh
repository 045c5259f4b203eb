# SPDX-License-Identifier: Apache-2.0
about="the tool for device descriptions, with sanitizers; LEXICAN_CORPUS may name a directory of descriptions to be read"
packages=("${build_packages[@]}" "${tool_packages[@]}" chromium)

lane() {
  local targets=(lexican_codict_tests lexican_codict_node_tests codict)
  build_tree codict -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-g1 -O0" -DLEXICAN_SANITIZE=address,undefined \
    -DLEXICAN_TOOLS=ON -DLEXICAN_WARNINGS_AS_ERRORS=ON || return
  run_doctest codict "$build/codict/tests/codict/lexican_codict_tests"
  run_doctest "codict nodes" "$build/codict/tests/codict/lexican_codict_node_tests"
  run_tap "$root/tests/codict/page_test.sh" "$build/codict/tools/codict/codict" "$root/tests/codict/fixtures"
}
