# SPDX-License-Identifier: Apache-2.0
about="small C and C++ projects that use the library in each documented way${full:+, and codict, also cross-compiled}"
minutes=2
packages=("${build_packages[@]}" pkg-config)
[ -z "$full" ] || packages+=("${tool_packages[@]}" "${arm_packages[@]}" make)

lane() {
  local codict without=() targets=(lexican)
  if [ -n "$full" ]; then
    host_codict || return
  else
    without=(-LE cross)
    build_preset release release -DLEXICAN_THIN_SWEEPS=ON || return
  fi
  { flock 9 && run_ctest package "$build/release/tests/package" "${without[@]}"; } 9>"$build/host-codict.lock"
}
