# SPDX-License-Identifier: Apache-2.0
about="all doctest cases on other CPUs, emulated: i686 (32 bits), s390x (big-endian), powerpc (both)"
packages=("${build_packages[@]}" g++-i686-linux-gnu=i686-linux-gnu-g++ g++-s390x-linux-gnu=s390x-linux-gnu-g++
  g++-powerpc-linux-gnu=powerpc-linux-gnu-g++ qemu-user-static=qemu-s390x-static)

lane() {
  on_cpu i686 qemu-i386-static
  on_cpu s390x qemu-s390x-static
  on_cpu powerpc qemu-ppc-static
}

on_cpu() {  # CPU EMULATOR
  local targets=(lexican_tests)
  build_tree "$1" -DCMAKE_BUILD_TYPE=Release -DLEXICAN_THIN_SWEEPS=ON \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$1-linux-gnu.cmake" || return
  run_doctest "$1" "$2" -L "/usr/$1-linux-gnu" "$build/$1/tests/lexican_tests"
}
