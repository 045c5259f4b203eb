# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Functions shared by the lanes fuzz, gcc and tools.
stack_fuzz_targets=(callbacks node sdo_client sdo_server)
tool_fuzz_targets=(eds json log monitor network socketcand xdd)
fuzz_targets=("${stack_fuzz_targets[@]}" "${tool_fuzz_targets[@]}")

# Builds only "${fuzz_targets[@]}" and the code that they test, with the preset full: build_fuzz NAME COMPILER
# C++-COMPILER SANITIZERS
build_fuzz() {
  local targets=("${fuzz_targets[@]/%/_fuzz}")
  build_tree "$1" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_COMPILER="$2" -DCMAKE_CXX_COMPILER="$3" -DCMAKE_CXX_FLAGS_DEBUG="-g -O1" \
    -DLEXICAN_SANITIZE="$4" -DLEXICAN_FUZZ=ON -DLEXICAN_PRESET=full -DLEXICAN_TESTS=OFF -DLEXICAN_ASSERT=ON -DLEXICAN_TOOLS=ON -DLEXICAN_DEMO=OFF \
    -DLEXICAN_DRIVERS=OFF -DLEXICAN_INSTALL=OFF -DLEXICAN_WARNINGS_AS_ERRORS=ON
}
