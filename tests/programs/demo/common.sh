# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Functions shared by the shell tests of the demo. A test prints a line for each case; its status is 0 if all have
# passed.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
work=$(mktemp -d)
failures=0

verdict() {  # STATUS CASE DETAIL
  if [ "$1" -eq 0 ]; then
    echo "ok $2"
  else
    failures=$((failures + 1))
    echo "not ok $2: $3"
  fi
}

# Ends the test with status 0 if all cases have passed, else 1.
finish() { exit $((failures > 0)); }

# Checks that a command ends with this status, and that its output (standard output and error) matches the pattern.
ends() {  # CASE STATUS PATTERN COMMAND...
  local name=$1 expected=$2 pattern=$3 output status=0
  shift 3
  output=$("$@" 2>&1 </dev/null) || status=$?
  # shellcheck disable=SC2053  # a pattern
  [ "$status" -eq "$expected" ] && [[ $output == $pattern ]]
  verdict $? "$name" "expected status $expected and '$pattern', got status $status and '$output'"
}

# Waits minutes until a file has a matching line, for a busy machine: await FILE REGEX
await() {
  local tries=6000
  until grep -qsE "$2" "$1" || [ $((tries -= 1)) -eq 0 ]; do sleep 0.05; done
  [ $tries -gt 0 ]
}
