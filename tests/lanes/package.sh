# SPDX-License-Identifier: Apache-2.0
about="small C and C++ projects that use the library in each documented way${full:+, and codict, also cross-compiled}"
minutes=${full:+2}
: "${minutes:=2}"
packages=("${build_packages[@]}" pkg-config)
[ -z "$full" ] || packages+=("${tool_packages[@]}" "${arm_packages[@]}" make)

lane() {
  build_preset release || return
  local without=()
  [ -n "$full" ] || without=(-LE cross)
  run_ctest package "$build/release/tests/package" "${without[@]}"
}
