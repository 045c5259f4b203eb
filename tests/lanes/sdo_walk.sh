# SPDX-License-Identifier: Apache-2.0
about="the SDO server beside its model: all pairs of requests from every state, all triples, 20 million of chance, gcc -O2"
packages=("${build_packages[@]}")

lane() {
  build_preset release || return
  LEXICAN_SDO_WALK=all run_doctest sdo_walk "$build/release/tests/lexican_tests" -tc='machine walk: SDO*'
}
