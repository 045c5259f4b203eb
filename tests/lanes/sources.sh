# SPDX-License-Identifier: Apache-2.0
about="clang-format, licence lines, the language of comments, the include rules, the tags of rules, and the test runner, with self-tests"
minutes=1
packages=(clang-format-14 python3)

lane() {
  check "clang-format" formatted
  check "licence lines" licensed
  local script
  for script in tests/lanes/language.py tests/lanes/layers.py tests/stack/conformance/rules.py; do
    run_tap python3 "$root/$script" "$root"
    run_tap python3 "$root/$script" --self-test
  done
  test_the_runner
}

# Generated files are excluded: they have the format of their generators.
formatted() {
  local files
  mapfile -t files < <(sources include config src drivers tools demo tests -name '*.[ch]' -o -name '*.[ch]pp' |
    grep -v /generated/)
  [ ${#files[@]} -gt 0 ] || return
  local unformatted
  unformatted=$(cd "$root" && clang-format-14 --dry-run -Werror "${files[@]}" 2>&1 | grep -oE '^[^: ]+:[0-9]+:.*error' |
    cut -d: -f1 | sort | uniq -c)
  [ -z "$unformatted" ] || { printf 'places to be formatted:\n%s\n' "$unformatted"; return 1; }
}

licensed() {
  local without
  without=$(cd "$root" && sources include config src drivers tools demo tests cmake .ci \
    -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.sh' -o -name '*.py' -o -name '*.cmake' -o -name CMakeLists.txt -o -name run |
    grep -v /generated/ |
    while read -r file; do head -n 2 "$file" | grep -q 'SPDX-License-Identifier: Apache-2.0' || echo "$file"; done)
  [ -z "$without" ] || { printf 'no licence line:\n%s\n' "$without"; return 1; }
}

# The test runner detects cases that did not run, programs that end early, files that are not built, and warnings.
test_the_runner() {
  counts doctest "4 0" 4 2
  counts doctest "4 1" 5 2
  counts doctest "0 1" 0 0
  counts doctest "0 3" 4 ends_early
  counts tap "2 0" 2 "ok a" "ok b"
  counts tap "1 1" 2 "ok a" "not ok b"
  counts tap "1 1" 2 "ok a"
  check "a lane that runs nothing fails" fails_empty_lane
  check "a file that is not built fails" counts_of "1 0" built_of a_test.cpp b_test.cpp
  check "files that are built pass" counts_of "0 1" built_of a_test.cpp
  check "a build without a warning passes" counts_of "0 0" build_that_prints "[1/1] Building warning.cpp.o"
  check "a build with a warning of the compiler fails" counts_of "1 0" build_that_prints "a.cpp:1:1: warning: unused variable"
  check "a build with a warning of CMake fails" counts_of "1 0" build_that_prints "CMake Deprecation Warning at a.cmake:1:"
  check "a build with a warning of the assembler fails" counts_of "1 0" build_that_prints "a.s:1: Warning: ignored"
  check "a skipped case says what it needs" skips_with_suite
  check "a skipped case without that is counted" skips_without_suite
  check "a failed case is not skipped with the lane" counts_of "1 1" run_tap skipping_program
}

# Runs a function in a subshell, and checks the numbers of failed and passed cases.
counts_of() {  # "FAILED PASSED" COMMAND...
  local counted
  counted=$(
    passed=0 failed=0
    "${@:2}" >&2
    echo "$failed $passed"
  )
  echo "$counted instead of $1"
  test "$counted" = "$1"
}

# Simulates a tree in which only a_test.cpp is built.
built_of() {  # FILE...
  local files=("$@")
  sources() { printf '%s\n' "${files[@]}"; }
  ninja() { printf 'a.o: #deps 1\n    %s\n' "$root/a_test.cpp"; }
  built_from tree
}

build_that_prints() {  # LINE
  local line=$1 build=$results/sources-build
  mkdir -p "$build/planted"
  cmake() { echo "$line"; }
  build_tree planted
}

skips_with_suite() {
  program() { echo '<TestCase name="a" testsuite="needs a bus" filename="a.cpp" line="1" skipped="true"/>'; }
  (count_unrun "a program" program) | grep -x '   SKIPPED 1 cases of a program: needs a bus'
}

skips_without_suite() {
  program() { echo '<TestCase name="a case" filename="a.cpp" line="1" skipped="true"/>'; }
  (count_unrun "a program" program) | grep -x '   SKIPPED 1 cases of a program: no suite says what "a case" needs'
}

skipping_program() {
  printf 'ok a\nnot ok b\n1..2\n'
  return 77
}

fails_empty_lane() {
  (
    passed=0 failed=0 lane_name=sources-inner
    lane() { :; }
    measure_lane
  ) && test "$(cat "$results/sources-inner.count")" = "0 1 0"
}

# Runs a program of one of the forms below in a subshell, and checks the numbers of passed and failed cases.
counts() {  # KIND "PASSED FAILED" ARGUMENT...
  local kind=$1 expected=$2 counted
  shift 2
  counted=$(
    passed=0 failed=0 lane_name=sources-inner
    now_in() { :; }
    "run_$kind" ${kind/tap/} "${kind}_program" "$@" >"$results/sources-inner.log"
    echo "$passed $failed"
  )
  check "$kind $*: $counted (passed, failed) instead of $expected" test "$counted" = "$expected"
}

# Prints what a doctest program prints that lists some cases and runs some in each of two processes: LISTED RAN-EACH
doctest_program() {
  case "$*" in
    *--count*) echo "[doctest] unskipped test cases passing the current filters: $1" ;;
    *--list-test-cases*) ;;
    *ends_early*) return 1 ;;
    *) echo "[doctest] test cases: $2 | $2 passed | 0 failed | 0 skipped" ;;
  esac
}

tap_program() {  # PLANNED LINE...
  echo "1..$1"
  shift
  printf '%s\n' "$@"
}
