# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="all doctest cases of hosts on i686 (32 bits), native if this CPU supports it, else emulated"
packages=("${build_packages[@]}" g++-i686-linux-gnu=i686-linux-gnu-g++ qemu-user-static=qemu-i386-static)

lane() {
  local targets=(lexican_tests) libraries=/usr/i686-linux-gnu/lib
  build_tree i686 -DCMAKE_BUILD_TYPE=Release -DLEXICAN_THIN_SWEEPS=ON \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/i686-linux-gnu.cmake" || return
  local runs=("$libraries/ld-linux.so.2" --library-path "$libraries")
  "${runs[@]}" --list "$build/i686/tests/lexican_tests" >/dev/null 2>&1 || runs=(qemu-i386-static -L /usr/i686-linux-gnu)
  run_doctest i686 "${runs[@]}" "$build/i686/tests/lexican_tests"
}
