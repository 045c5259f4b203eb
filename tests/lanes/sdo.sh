# SPDX-License-Identifier: Apache-2.0
about="SDO: pairs and triples of faults in transfers; the server against its model with all pairs and triples of requests from every state and 20 million random ones; gcc -O2"
minutes=90
packages=("${build_packages[@]}")

lane() {
  local targets=(lexican_tests)
  walk
  faults
}

walk() {
  build_preset release sdo-walk -DLEXICAN_TEST_FILES=machine_walk || return
  LEXICAN_SDO_WALK=all run_doctest sdo_walk "$build/sdo-walk/tests/lexican_tests" -tc='machine walk: SDO*'
}

# Runs the faults twice; the second build's server has blocks of 8 segments.
faults() {
  local small=-DCO_SDO_BUF_SEG=8
  build_preset release sdo-faults -DLEXICAN_TEST_FILES=sdo_fault || return
  suffer blocks-of-127 "$build/sdo-faults/tests/lexican_tests"
  build_preset release sdo-faults-8 -DLEXICAN_TEST_FILES=sdo_fault -DCMAKE_C_FLAGS=$small -DCMAKE_CXX_FLAGS=$small || return
  suffer blocks-of-8 "$build/sdo-faults-8/tests/lexican_tests" -tce='*65536*,*three blocks*'
}

suffer() {  # NAME PROGRAM [ARGUMENT...]
  local name=$1
  shift
  LEXICAN_SDO_FAULTS=all one_half="*/sdo_fault_pairs_*" run_doctest "sdo_faults-$name" "$@" -tc='SDO faults:*'
}
