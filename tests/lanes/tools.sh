# SPDX-License-Identifier: Apache-2.0
about="codict, the tool for device descriptions${full:+, with its program, and the bus tool lexican, clang with sanitizers; --all: both also linked statically, lexican for three CPUs, and as Debian packages}"
minutes=${full:+5}
: "${minutes:=2}"
. "$root/tests/fuzz/build.sh"
packages=("${build_packages[@]}" "${tool_packages[@]}")
[ -z "$full" ] || packages+=("${clang_packages[@]}" "${arm_packages[@]}" python3 chromium groff-base=groff tmux)
[ -z "$all" ] || packages+=(debhelper=dh dpkg-dev=dpkg-buildpackage lintian qemu-user-static=qemu-aarch64-static
  g++-aarch64-linux-gnu=aarch64-linux-gnu-g++ g++-arm-linux-gnueabihf=arm-linux-gnueabihf-g++)

# The contributor's run builds and tests only the library of the tool, without sanitizers and fuzz targets: the program
# takes longer to build.
lane() {
  if [ -z "$full" ]; then
    local source=tools/codict targets=(lexican_codict_core_tests)
    build_tree codict-core -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-g0 -O0" -DLEXICAN_TESTS=ON || return
    run_doctest codict "$build/codict-core/tests/lexican_codict_core_tests"
  else
    all_cases
    [ -z "$all" ] || linked_statically
    [ -z "$all" ] || debian_packages
  fi
}

# build.sh fetches the libraries of the other CPUs into its build directory: no architecture is added to the machine.
linked_statically() {
  local source=tools/codict targets=(codict) architecture node=$build/codict/demo/linux_node/lexican-demo-node
  local -A emulators=([amd64]=qemu-x86_64-static [arm64]=qemu-aarch64-static [armhf]=qemu-arm-static)
  emulators[$(dpkg --print-architecture)]=
  build_tree codict-static -DLEXICAN_STATIC=ON && run_tap "$root/tools/static/test.sh" "$build/codict-static/codict"
  for architecture in "${!emulators[@]}"; do
    check "lexican as one file for $architecture" "$root/tools/static/build.sh" lexican "$architecture" \
      -DLEXICAN_WARNINGS_AS_ERRORS=ON
    run_tap "$root/tools/static/test.sh" "$build/static-$architecture/tools/lexican/lexican" "$node" \
      "${emulators[$architecture]}"
  done
}

debian_packages() {
  copy_sources
  cp -r "$copy/tools/debian" "$copy/debian"
  check "the Debian packages have the version of the project" same_version
  check "build of the Debian packages" in_copy env DEB_BUILD_OPTIONS=noautodbgsym dpkg-buildpackage -b -us -uc
  check "lintian" in_copy lintian --fail-on error,warning
}

in_copy() { (cd "$copy" && "$@"); }

same_version() {
  local version
  version=$(in_copy dpkg-parsechangelog -S Version) && grep "^project(lexican VERSION $version " "$root/CMakeLists.txt"
}

# Compiled by clang, which takes half the time of gcc; lane package compiles the program with gcc. Only those checks for
# undefined behaviour that the address sanitizer does not make: the others, of each pointer and reference, take a quarter
# of the time to compile. The tests themselves are compiled without any. There is no debug information, which takes a
# sixth of the time: reports have the names of functions.
undefined=shift,signed-integer-overflow,integer-divide-by-zero,float-cast-overflow,bounds,bool,enum,return,unreachable
all_cases() {
  local codict target script of=$build/codict/tools/codict targets=(lexican_codict_core_tests lexican_codict_tests
    lexican_codict_program_tests lexican_codict_memory_tests lexican_codict_node_tests lexican_codict_bench codict
    codict_words lexican_tool lexican_words lexican_tool_tests lexican-demo-node
    "${tool_fuzz_targets[@]/%/_fuzz}")
  build_tree codict -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS_DEBUG="-O0" -DLEXICAN_SANITIZE=address,$undefined \
    -DLEXICAN_TEST_OPTIONS="-O0;-fno-sanitize=all" -DLEXICAN_PRESET=sim -DLEXICAN_TOOLS=ON -DLEXICAN_FUZZ=ON || return
  run_doctest "codict core" "$of/tests/lexican_codict_core_tests"
  run_doctest codict "$of/tests/lexican_codict_tests"
  run_doctest "codict program" "$of/tests/lexican_codict_program_tests"
  run_doctest "codict nodes" "$of/tests/lexican_codict_node_tests"
  run_doctest "lexican" "$build/codict/tools/lexican/lexican_tool_tests"
  built_from codict tools/codict/tests tools/lexican/tests -name '*_test.cpp'
  host_codict && LEXICAN_CODICT=$codict run_doctest "codict memory" "$of/tests/lexican_codict_memory_tests"
  codict_pages
  for target in "${tool_fuzz_targets[@]}"; do
    check "fuzz target $target" "$build/codict/tests/fuzz/${target}_fuzz" "$root/tests/fuzz/inputs/$target.txt"
  done
  check "installation with the manual page and completion" install_program codict
  check "installation of the bus tool" install_program lexican
  check "docs/pictures shows the output of codict check" same_screen "$of/codict"
  run_tap "$root/tools/codict/tests/page_test.py" "$of/codict" "$root/tools/codict/tests/fixtures"
  for script in pages picture terminal; do
    run_tap "$root/tools/lexican/tests/$script.py" "$build/codict/tools/lexican/lexican" \
      "$build/codict/demo/linux_node/lexican-demo-node"
  done
}

same_screen() {  # CODICT
  "$root/docs/site/screens.py" "$results" "$1" &&
    diff "$results/screen_check.svg" "$root/docs/pictures/screen_check.svg"
}

install_program() {  # NAME
  local prefix=$build/codict/prefix-$1
  rm -rf "$prefix"
  cmake --install "$build/codict" --component "$1" --prefix "$prefix" &&
    "$prefix/bin/$1" --version &&
    grep "^\.TH ${1^^} 1" "$prefix/share/man/man1/$1.1" &&
    grep "^complete .* $1\$" "$prefix/share/bash-completion/completions/$1" &&
    grep "^#compdef $1\$" "$prefix/share/zsh/site-functions/_$1" &&
    grep "^complete -c $1 " "$prefix/share/fish/vendor_completions.d/$1.fish"
}

# Runs the commands of the pages with descriptions in place of those that a reader has.
codict_pages() {
  local fixtures=$root/tools/codict/tests/fixtures
  copy_sources
  mkdir -p "$copy/build/codict"
  ln -s "$codict" "$copy/build/codict/codict"
  cp "$fixtures"/network/{drive.eds,io.eds,plan.yaml} "$root"/demo/clock/{clock.xdd,generated/clock.eds} "$copy"
  cp "$root/demo/clock/clock.xdd" "$copy/device.xdd"
  PATH=$copy/build/codict:$PATH run_pages "$copy"
  local page=docs/start/4-from-an-eds.md
  run_tap python3 "$root/tests/programs/porting/excerpts.py" "$root" $page
  run_tap python3 "$root/tests/programs/porting/excerpts.py" --some "$root" docs/use.md
  check "$page shows the output of its program" python3 "$root/tests/programs/commands/page_output.py" "$root/$page" \
    heater_simulation "${copy%/*}/heater/build/heater_simulation"
}
