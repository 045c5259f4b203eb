# SPDX-License-Identifier: Apache-2.0
about="clang-tidy over src, drivers and tools, with the checks of .clang-tidy"
packages=("${build_packages[@]}" "${clang_packages[@]}" "${tool_packages[@]}" clang-tidy-14)

# How each file is compiled is known once the preset is configured: nothing is built here.
lane() {
  (cd "$root" && cmake --preset development -DLEXICAN_TOOLS=ON) >"$results/tidy.log" 2>&1 || { fail configuration "$results/tidy.log"; return; }
  local file logs=$results/tidy
  rm -rf "$logs" && mkdir -p "$logs"
  sources src drivers tools -name '*.cpp' -not -path '*/template/*' |
    xargs -P "$(nproc)" -I FILE bash -c '
      log=$1/$(tr / - <<<"$2").log
      clang-tidy-14 -p "$3" --quiet --warnings-as-errors="*" "$4/$2" >"$log" 2>&1 && echo clean >>"$log"' \
      tidy "$logs" FILE "$build/development" "$root"
  for file in "$logs"/*.log; do
    check "${file##*/}" clean_log "$file"
  done
}

clean_log() { [ "$(tail -n 1 "$1")" = clean ] || { grep -E 'warning:|error:' "$1" || cat "$1"; false; }; }
