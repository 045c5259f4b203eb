# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="all doctest cases with each further compiler of the distribution, the newest also as C++20, with other options and other SDO and PDO configurations, and on i686, emulated where the CPU does not support it"
packages=("${build_packages[@]}" g++-i686-linux-gnu=i686-linux-gnu-g++ qemu-user-static=qemu-i386-static)

lane() {
  other_compilers
  configurations
  i686
}

other_compilers() {
  local version
  for version in g++-11 clang-13 clang-15 clang-16 clang-19; do
    with_compiler "$version" 17
  done
  with_compiler g++-12 20
  with_compiler clang-19 20
}

with_compiler() {  # PACKAGE STANDARD
  local package=$1 c=${1/g++/gcc} cxx=${1/clang/clang++} targets=(lexican_tests)
  if ! install_packages "$package=$cxx"; then
    skip "$package, C++$2: not available"
    return
  fi
  build_tree "compiler-$package-$2" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_STANDARD="$2" \
    -DLEXICAN_THIN_SWEEPS=ON -DCMAKE_C_COMPILER="$c" -DCMAKE_CXX_COMPILER="$cxx" || return
  run_doctest "$package-c++$2" "$build/compiler-$package-$2/tests/lexican_tests"
}

configurations() {
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

i686() {
  local targets=(lexican_tests) libraries=/usr/i686-linux-gnu/lib
  build_tree i686 -DCMAKE_BUILD_TYPE=Release -DLEXICAN_THIN_SWEEPS=ON \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/i686-linux-gnu.cmake" || return
  local runs=("$libraries/ld-linux.so.2" --library-path "$libraries")
  "${runs[@]}" --list "$build/i686/tests/lexican_tests" >/dev/null 2>&1 || runs=(qemu-i386-static -L /usr/i686-linux-gnu)
  run_doctest i686 "${runs[@]}" "$build/i686/tests/lexican_tests"
}
