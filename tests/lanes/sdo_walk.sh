# SPDX-License-Identifier: Apache-2.0
about="the SDO server against its model: all pairs and triples of requests from every state, 20 million random ones, gcc -O2"
packages=("${build_packages[@]}")

lane() {
  build_preset release || return
  LEXICAN_SDO_WALK=all run_doctest sdo_walk "$build/release/tests/lexican_tests" -tc='machine walk: SDO*'
}
