# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Functions shared by all lanes. A lane file sets
#   about      one line for --list
#   minutes    approximate duration of the lane when it runs alone on two cores, for --list
#   packages   PACKAGE[=PROBE]... (see cmake/install_packages.sh)
#   optional   not empty: the lane is skipped, with a reason, where its packages cannot be installed
#   waiting    not empty: the lane mostly waits, so it runs beside two others and before them
# and defines lane(), which reports each case by the functions below. The runner sets $lane_name, $root, $build and
# $results; $full is empty in the contributor's run.

passed=0
failed=0
skipped=0

pass() { passed=$((passed + 1)); }

fail() {  # WHAT [LOG]
  failed=$((failed + 1))
  echo "   FAILED $1"
  [ -z "${2:-}" ] || tail -n 60 "$2" | sed 's/^/      /'
}

# Runs a command as one case: check WHAT COMMAND...
check() {
  local what=$1 log=$results/$lane_name-check.log
  shift
  now "$((passed + failed)) cases, $what"
  if "$@" >"$log" 2>&1; then
    pass
  else
    fail "$what" "$log"
  fi
}

skip() {  # WHAT AND WHY: one case
  skipped=$((skipped + 1))
  echo "   SKIPPED $1"
}

# Informs tests/run of what the lane does now: now TEXT, or by the log that shows its progress and the number of its
# cases: now_in LOG [CASES]
now() { echo "$1" >"$results/$lane_name.now"; }
now_in() { now "log ${2:-0} $1"; }

measure_lane() {
  trap 'echo "$passed $failed $skipped" >"$results/$lane_name.count"' EXIT
  rm -f "$results/$lane_name.count"
  lane || [ "$failed" -gt 0 ] || fail "$lane_name ended early"
  [ $((passed + failed + skipped)) -gt 0 ] || fail "$lane_name ran nothing"
}

# Builds "${targets[@]}", by default all, of the project in $source, by default the stack, in build/NAME: build_tree
# NAME CMAKE-ARGUMENT... The preset is full unless an argument sets another one, as it has several SDO servers. The
# tools are not built: they have a lane. A warning is a failure. Lanes that share a build tree build one after the other.
build_tree() {
  local name=$1 log=$results/build-$lane_name-$1.log
  shift
  mkdir -p "$build"
  if ! {
    now "waits until another lane has built $name"
    flock 9
    now_in "$log"
    cmake --no-warn-unused-cli -S "$root/${source:-}" -B "$build/$name" -G Ninja -DLEXICAN_PRESET=full -DLEXICAN_TEST_FILES= -DLEXICAN_THIN_SWEEPS=OFF \
      -DLEXICAN_PRECOMPILED=ON -DLEXICAN_TEST_BATCH=32 -DLEXICAN_WARNINGS_AS_ERRORS=ON -DCMAKE_C_COMPILER_LAUNCHER="$launcher" \
      -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" "$@" &&
      cmake --build "$build/$name" --target "${targets[@]:-all}"
  } 9>"$build/$name.lock" >"$log" 2>&1; then
    fail "build of $name" "$log"
    return 1
  elif grep -iE '\bwarning: |CMake (Deprecation )?Warning' "$log" >"$log.warnings"; then
    rm -r "${build:?}/$name"  # the next run must warn again
    fail "build of $name: a warning" "$log.warnings"
    return 1
  fi
}

# Builds a preset of CMakePresets.json in build/NAME; NAME is by default the name of the preset.
build_preset() {  # PRESET [NAME CMAKE-ARGUMENT...]
  local preset=$1 name=${2:-$1}
  shift
  (cd "$root" && build_tree "$name" --preset "$preset" "${@:2}")
}

# Builds "${targets[@]}" with gcc's sanitizers in build/gcc. The sweeps are thin: lane clang runs them completely. The tests'
# own code has the redzones of the address sanitizer, so that the stack cannot leave memory of a test, but its own accesses
# are not checked, which would take half the time of its compilation; lane clang checks them with --all. Without fast paths: lane
# clang has them.
sanitized_tree() {
  local redzones="--param=asan-instrument-reads=0;--param=asan-instrument-writes=0;-fno-sanitize-address-use-after-scope"
  build_tree gcc -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_COMPILER=gcc -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_FLAGS_DEBUG="-g1 -O1" \
    -DCMAKE_CXX_FLAGS_DEBUG="-g1 -O1" -DCMAKE_C_FLAGS=-DUSE_FAST_PATHS=0 -DCMAKE_CXX_FLAGS=-DUSE_FAST_PATHS=0 \
    -DLEXICAN_SANITIZE=address,undefined -DLEXICAN_FUZZ=ON -DLEXICAN_THIN_SWEEPS=ON \
    -DLEXICAN_TEST_OPTIONS="-O0;-g0;-fno-sanitize=undefined;$redzones"
}

# Builds codict as a project for another machine does (tests/programs/package), once for all lanes, and sets $codict to its path.
host_codict() {
  local targets=(lexican) log=$results/$lane_name-host-codict.log
  codict=$build/release/tests/programs/package/generate.cross/lexican_host_codict/codict
  build_preset release || return
  now "waits until another lane has built codict"
  if ! {
    flock 9
    now "building codict"
    ctest --test-dir "$build/release/tests/programs/package" --no-tests=error --output-on-failure -R '^package\.generate\.cross$'
  } 9>"$build/host-codict.lock" >"$log" 2>&1; then
    fail "build of codict" "$log"
    return 1
  fi
}

# Builds node, master and SRDO demo as their users do, once for all lanes, and sets $demo to the directory of the
# programs. In a fresh clone a warning is a failure.
host_demo() {
  local log=$results/$lane_name-demo.log
  demo=$build/demo/demo
  now "building the demo"
  local arguments
  for arguments in --virtual "master --version" srdo; do
    # shellcheck disable=SC2086
    CFLAGS=-Werror CXXFLAGS=-Werror "$root/demo/run" $arguments >"$log" 2>&1 || { fail "demo/run $arguments" "$log"; return 1; }
  done
}

# Runs a doctest program and counts its cases: run_doctest WHAT COMMAND... Two processes run at the same time, one with
# the cases of the files $one_half (SDO), one with all others, about half of the work each. All cases that the program
# lists must have run.
run_doctest() {
  local what=$1 log=$results/doctest-${1//[^a-zA-Z0-9_]/-} half=${one_half:-*/sdo_*} ran=0 listed
  shift
  listed=$("$@" --no-colors --count 2>/dev/null | grep -oE '[0-9]+$')
  now_in "$log" "${listed:-0}"
  (LEXICAN_PROGRESS=$log-1.log.progress "$@" --no-colors -sf="$half" >"$log-1.log" 2>&1) 2>>"$log-1.log" &
  (LEXICAN_PROGRESS=$log-2.log.progress "$@" --no-colors -sfe="$half" >"$log-2.log" 2>&1) 2>>"$log-2.log"
  count_doctest "$what" $? "$log-2.log"
  wait $!
  count_doctest "$what" $? "$log-1.log"
  [ "$ran" -gt 0 ] && [ "$ran" -eq "${listed:-0}" ] || fail "$what: $ran of ${listed:-an unknown number of} test cases ran"
  count_unrun "$what" "$@"
}

# Adds the number of cases that one process has run to $ran.
count_doctest() {  # WHAT STATUS LOG
  local summary='^\[doctest\] test cases: +([0-9]+) \| +([0-9]+) passed \| +([0-9]+) failed'
  if ! [[ $(grep '^\[doctest\] test cases:' "$3") =~ $summary ]]; then
    fail "$1: ended without a summary (status $2)" "$3"
    return
  fi
  local bad=${BASH_REMATCH[3]}
  ran=$((ran + BASH_REMATCH[1])) passed=$((passed + BASH_REMATCH[2]))
  if [ "$bad" -gt 0 ]; then
    fail "$1: $bad test cases" "$3"
    failed=$((failed + bad - 1))
  elif [ "$2" -ne 0 ]; then
    fail "$1: status $2" "$3"
  fi
}

# Counts the cases that the program skips on this machine (doctest::skip), by their suite, which says what they need.
count_unrun() {  # WHAT COMMAND...
  local what=$1 unrun line
  shift
  unrun=$("$@" --list-test-cases --reporters=xml --no-skip=true 2>/dev/null | grep 'skipped="true"' |
    sed 's/.* testsuite="\([^"]*\)".*/\1/; s/.*<TestCase name="\([^"]*\)".*/no suite says what "\1" needs/')
  [ -n "$unrun" ] || return 0
  line=$(wc -l <<<"$unrun")
  skipped=$((skipped + line))
  sort <<<"$unrun" | uniq -c | sed -E "s/^ *([0-9]+) (.*)/   SKIPPED \1 cases of $what: \2/"
}

# Checks that each of these source files is compiled in a build tree, by itself or in a batch: built_from TREE
# PLACE... -name PATTERN
built_from() {
  local tree=$1 missing
  shift
  missing=$(comm -23 <(sources "$@" | grep . || echo nothing) <(ninja -C "$build/$tree" -t deps | sed -n "s#^ *$root/##p" | sort -u))
  if [ -z "$missing" ]; then pass; else fail "not built in $tree: ${missing//$'\n'/ }"; fi
}

# Runs the ctest cases of a build directory and counts them: run_ctest WHAT DIRECTORY [CTEST-ARGUMENT...]
run_ctest() {
  local what=$1 directory=$2 log=$results/ctest-${1//[^a-zA-Z0-9_]/-}
  shift 2
  rm -f "$log.xml"
  now_in "$log.log"
  ctest --test-dir "$directory" --no-tests=error --output-on-failure -j "$(nproc)" --output-junit "$log.xml" "$@" \
    >"$log.log" 2>&1
  local status=$?
  if [ ! -f "$log.xml" ]; then
    fail "$what: no test was run" "$log.log"
    return
  fi
  local ran bad unrun
  ran=$(junit_count tests "$log.xml") bad=$(junit_count failures "$log.xml") unrun=$(junit_count skipped "$log.xml")
  passed=$((passed + ran - bad - unrun)) skipped=$((skipped + unrun))
  [ "$unrun" -eq 0 ] || skipped_tests "$log.log"
  if [ "$bad" -gt 0 ]; then
    fail "$what: $bad tests" "$log.log"
    failed=$((failed + bad - 1))
  elif [ $status -ne 0 ] || [ "$ran" -eq 0 ]; then
    fail "$what: ctest status $status" "$log.log"
  fi
  local listed
  listed=$(ctest --test-dir "$directory" -N "$@" | sed -n 's/^Total Tests: //p')
  [ "$ran" -eq "${listed:-0}" ] || fail "$what: $ran of ${listed:-an unknown number of} tests ran"
}

# Prints the reasons that skipped tests have printed.
skipped_tests() { grep -A 3 -E '\*\*\*Skipped' "$1" | grep -oE 'skipped: .*' | sort | uniq -c | sed 's/^ */   SKIPPED /'; }

junit_count() { grep -oE "\b$1=\"[0-9]+\"" "$2" | head -n 1 | grep -oE '[0-9]+'; }

# Runs a program and counts its lines "ok …" ("ok … # SKIP why" is skipped) and "not ok …"; their number must be the N
# of its line "1..N". With status 77 the lane is skipped, with the program's last line as the reason: run_tap COMMAND...
run_tap() {
  local log=$results/$lane_name.tap
  now_in "$log"
  "$@" >"$log" 2>&1
  local status=$? ok bad unrun planned
  if [ $status -eq 77 ] && ! grep -qE '^(not )?ok ' "$log"; then
    skip "$(tail -n 1 "$log")"
    return
  fi
  ok=$(grep -c '^ok ' "$log") bad=$(grep -c '^not ok ' "$log")
  unrun=$(grep -c '^ok .*# SKIP ' "$log")
  planned=$(sed -n 's/^1\.\.\([0-9][0-9]*\)$/\1/p' "$log" | head -n 1)
  passed=$((passed + ok - unrun)) failed=$((failed + bad)) skipped=$((skipped + unrun))
  sed -n 's/^ok .*# SKIP /   SKIPPED /p' "$log" | sort | uniq -c
  sed -n 's/^not ok/   FAILED/p' "$log"
  if [ "${planned:-0}" -ne $((ok + bad)) ]; then
    fail "$lane_name: $((ok + bad)) of ${planned:-an unknown number of} cases came back (status $status)" "$log"
  elif [ $status -ne 0 ] && [ "$bad" -eq 0 ]; then
    fail "$lane_name: status $status" "$log"
  fi
}

# Copies the sources to a directory where a reader of the pages would have them, and sets $copy to its path.
copy_sources() {
  copy=$results/pages-$lane_name/lexican
  rm -rf "${copy%/*}"
  mkdir -p "$copy" "${copy%/*}/home"
  # tar would fail if another lane adds a file to the directory meanwhile.
  find "$root" -mindepth 1 -maxdepth 1 ! -name build ! -name .git -exec cp -a -t "$copy" {} +
}

# Runs the commands of the pages that name this lane (tests/programs/commands/commands.py): run_pages [DIRECTORY], by default in a
# copy of the sources.
run_pages() {
  local commands=$results/$lane_name.commands
  [ -n "${1:-}" ] || copy_sources
  python3 "$root/tests/programs/commands/commands.py" "$root" "$lane_name" >"$commands" && [ -s "$commands" ] ||
    { fail "no page has commands for this lane"; return; }
  run_tap env HOME="$results/pages-$lane_name/home" CFLAGS=-Werror CXXFLAGS=-Werror sh "$root/tests/programs/commands/commands.sh" \
    "$commands" "${1:-$copy}"
}

# Prints files of the project: sources src drivers -name '*.cpp'
sources() {
  local places=()
  while [ $# -gt 0 ] && [[ $1 != -* ]]; do
    if [ -d "$root/$1" ]; then places+=("$1"); else echo "$1, which does not exist"; fi
    shift
  done
  (cd "$root" && find "${places[@]}" -type f "$@" | sort)
}

build_packages=(g++ cmake ninja-build=ninja doctest-dev=/usr/include/doctest/doctest.h
  libcli11-dev=/usr/include/CLI/CLI.hpp)
clang_packages=(clang libclang-rt-dev='/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.asan-*.a')
arm_packages=(gcc-arm-none-eabi=arm-none-eabi-g++ libnewlib-arm-none-eabi=/usr/lib/arm-none-eabi/newlib/libc.a
  libstdc++-arm-none-eabi-newlib=/usr/lib/arm-none-eabi/newlib/libstdc++.a)

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
