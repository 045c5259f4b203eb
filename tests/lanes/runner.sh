# SPDX-License-Identifier: Apache-2.0
about="the test runner: it detects cases that did not run and programs that end early"
minutes=1
packages=()

lane() {
  counts doctest "4 0" 4 2
  counts doctest "4 1" 5 2
  counts doctest "0 1" 0 0
  counts doctest "0 3" 4 ends_early
  counts tap "2 0" 2 "ok a" "ok b"
  counts tap "1 1" 2 "ok a" "not ok b"
  counts tap "1 1" 2 "ok a"
  check "a lane that runs nothing fails" fails_empty_lane
}

fails_empty_lane() {
  (
    passed=0 failed=0 lane_name=runner-inner
    lane() { :; }
    measure_lane
  ) && test "$(cat "$results/runner-inner.count")" = "0 1 0"
}

# Runs a program of one of the forms below in a subshell, and checks the numbers of passed and failed cases.
counts() {  # KIND "PASSED FAILED" ARGUMENT...
  local kind=$1 expected=$2 counted
  shift 2
  counted=$(
    passed=0 failed=0 lane_name=runner-inner
    now_in() { :; }
    "run_$kind" ${kind/tap/} "${kind}_program" "$@" >"$results/runner-inner.log"
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
