# SPDX-License-Identifier: Apache-2.0
about="SDO transfers with every pair of faults within 32 segments, pairs within 2000 bytes, and 50000 triples, gcc -O2"
minutes=30
packages=("${build_packages[@]}")

# Runs the complete sweep of faults twice; the second build's server has blocks of 8 segments.
lane() {
  local targets=(lexican_tests) small=-DCO_SDO_BUF_SEG=8
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
