# SPDX-License-Identifier: Apache-2.0
about="small C and C++ projects that use the library in each documented way${full:+, and codict, also cross-compiled}"
minutes=2
packages=("${build_packages[@]}" pkg-config python3)
[ -z "$full" ] || packages+=("${tool_packages[@]}" "${arm_packages[@]}" make)

lane() {
  local codict without=() targets=(lexican)
  if [ -n "$full" ]; then
    host_codict || return
  else
    without=(-LE cross)
    build_preset release release -DLEXICAN_THIN_SWEEPS=ON || return
  fi
  { flock 9 && run_ctest package "$build/release/tests/programs/package" "${without[@]}"; } 9>"$build/host-codict.lock"
  package_pages
}

# The pages show the CMakeLists.txt of a firmware. There is no make: the pages do not install it.
package_pages() {
  copy_sources
  mkdir "$copy/firmware" "${copy%/*}/bin"
  awk '/^```/ { inside = $0 == "```cmake" && !blocks++; next } inside' "$copy/docs/use.md" >"$copy/firmware/CMakeLists.txt"
  cp "$root/tests/programs/package/main.c" "$copy/firmware"
  ln -s /bin/false "${copy%/*}/bin/make"
  PKG_CONFIG_PATH=$build/release/tests/programs/package/prefix/lib/pkgconfig PATH=${copy%/*}/bin:$PATH run_pages "$copy"
  check "the firmware of docs/use.md runs" timeout 10 "$copy/firmware/build/firmware"
  check "the first build is optimised" grep -x 'CMAKE_BUILD_TYPE:STRING=Release' "$copy/build/lexican/CMakeCache.txt"
}
