# SPDX-License-Identifier: Apache-2.0
about="all doctest cases with other compiler options (-O3, link-time optimisation …) and other SDO and PDO configurations"
packages=("${build_packages[@]}")

lane() {
  # Optimises the tests' own code, too, and compiles each file without precompiled headers, to detect missing includes.
  test_options=(-DLEXICAN_TEST_OPTIONS= -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON)
  configuration O3 -O3
  test_options=()
  configuration lto "-O2 -flto=auto"
  configuration unsigned-char-short-enums "-O2 -funsigned-char -fshort-enums"
  # Smallest buffers, most channels, slowest block transfer, no block transfer and clients with the fewest functions.
  configuration one-segment "-O2 -DCO_SDO_BUF_SEG=1" slave
  configuration two-segments "-O2 -DCO_SDO_BUF_SEG=2 -DCO_SSDO_N=128 -DCO_CSDO_N=100" slave
  configuration segment-a-call "-O2 -DCO_SDO_BUF_SEG=8 -DCO_SDO_BLOCK_PACE=1" slave
  configuration no-block "-O2 -DUSE_SDO_BLOCK=0 -DUSE_CSDO_OWN=0" slave
  # No remote requests, no LSS in Operational, restricted CAN-IDs permitted, a gap between the frames of an SRDO; most PDOs.
  configuration no-remote "-O2 -DUSE_PDO_RTR=0 -DCO_LSS_IN_OPERATIONAL=0 -DCO_RESTRICTED_IDS=1 -DCO_SRDO_GAP=300"
  configuration pdo-512 "-O2 -DCO_RPDO_N=512 -DCO_TPDO_N=512" slave
}

test_options=()

configuration() {  # NAME FLAGS [PRESET]
  local targets=(lexican_tests)
  build_tree "configuration-$1" -DCMAKE_BUILD_TYPE= -DLEXICAN_PRESET="${3:-full}" -DCMAKE_C_FLAGS="$2" \
    -DCMAKE_CXX_FLAGS="$2" -DLEXICAN_THIN_SWEEPS=ON "${test_options[@]}" || return
  run_doctest "$1" "$build/configuration-$1/tests/lexican_tests"
}
