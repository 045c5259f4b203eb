# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Builds of the library that several lanes measure.

# Builds "${targets[@]}", by default all, in build/NAME with the preset slave: build_library NAME FLAGS CMAKE-ARGUMENT...
build_library() {
  build_tree "$1" -DLEXICAN_PRESET=slave -DLEXICAN_TESTS=OFF -DLEXICAN_DEMO=OFF -DLEXICAN_DRIVERS=OFF \
    -DLEXICAN_BENCH=OFF -DLEXICAN_FRAME_BOUND=OFF -DLEXICAN_SIZES=OFF -DLEXICAN_SWITCHES= \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="$2 -DNDEBUG" "${@:3}"
}

# The library for Cortex-M0+ at -Os, with the data that the stack depth is computed from; without link-time optimisation.
build_m0plus() {  # CMAKE-ARGUMENT...
  build_library m0plus "-Os -fstack-usage -fcallgraph-info=su,da" -DLEXICAN_CPU=cortex-m0plus \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake" "$@"
}
