# SPDX-License-Identifier: Apache-2.0
about="each fuzz target for LEXICAN_FUZZ_SECONDS (60), beginning with the committed inputs"
packages=("${build_packages[@]}" "${clang_packages[@]}" "${tool_packages[@]}")
. "$root/tests/fuzz/build.sh"

# Runs the fuzz targets; new inputs and findings are stored in build/fuzz-TARGET.
lane() {
  build_fuzz fuzz clang clang++ fuzzer-no-link,address,undefined || return
  local target
  for target in "${fuzz_targets[@]}"; do
    check "$target" fuzz "$target" "${LEXICAN_FUZZ_SECONDS:-60}"
    report "$target"
  done
}

fuzz() {  # TARGET SECONDS
  local work=$build/fuzz-$1
  mkdir -p "$work/corpus"
  "$root/tests/fuzz/inputs.py" unpack "$1" "$work/corpus"
  "$build/fuzz/tests/fuzz/${1}_fuzz" -max_total_time="$2" -max_len=1024 -timeout=20 -print_final_stats=1 \
    -artifact_prefix="$work/" "$work/corpus" >"$work/log" 2>&1
  local status=$?
  grep -E 'BROKEN|ERROR|Test unit written' "$work/log"
  return $status
}

report() {  # TARGET
  local executions
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$build/fuzz-$1/log")
  echo "   $1: ${executions:-unknown number of} executions"
}
