# SPDX-License-Identifier: Apache-2.0
about="line and branch coverage of src/ by all doctest cases and the C programs"
packages=("${build_packages[@]}" gcovr)

# Builds without asserts, as in firmware, and without optimisation, so that branches of the report are those of the
# source. USE_PDO_BITS=1 includes the code for single bits in addition to that for bytes.
lane() {
  local flags="--coverage -O0 -DNDEBUG -DUSE_PDO_BITS=1" program=$build/coverage/tests/lexican_tests
  build_tree coverage -DLEXICAN_ASSERT=OFF -DCMAKE_BUILD_TYPE= -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" || return
  find "$build/coverage" -name '*.gcda' -delete
  run_doctest coverage "$program"
  run_ctest coverage-compat "$build/coverage/tests/stack/compat"
  local lines branches
  read -r lines branches < <(grep -v '^#' "$root/tests/numbers/coverage_threshold")
  (cd "$root" && gcovr --root . --filter src/ --object-directory "$build/coverage" --exclude-unreachable-branches \
    --exclude-throw-branches --txt "$results/coverage-lines.txt" --html-details "$results/coverage.html" "$build/coverage" &&
    gcovr --root . --filter src/ --exclude-unreachable-branches --exclude-throw-branches --branches "$build/coverage" \
      >"$results/coverage-branches.txt") || fail "gcovr"
  echo "lines:"
  sed -n '/^File/,$p' "$results/coverage-lines.txt"
  echo "branches:"
  sed -n '/^File/,$p' "$results/coverage-branches.txt"
  check "at least $lines % of the lines" reaches "$lines" "$results/coverage-lines.txt"
  check "at least $branches % of the branches" reaches "$branches" "$results/coverage-branches.txt"
}

reaches() {  # PERCENT REPORT
  local got
  got=$(awk '$1 == "TOTAL" { sub("%", "", $4); print $4 }' "$2")
  echo "$got % of at least $1 %"
  [ -n "$got" ] && [ "$got" -ge "$1" ]
}
