# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
about="clang-tidy over src and drivers, with the checks of .clang-tidy; --all: also over the tools, with the default limit of its analyzer"
minutes=1
packages=("${build_packages[@]}" "${clang_packages[@]}" clang-tidy-14)
places=(src drivers)
with_tools=OFF
# States of a function that the analyzer explores. Its default is 225000, which takes six times as long.
limits=(--extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=max-nodes=25000)
[ -z "$all" ] || { packages+=("${tool_packages[@]}") places+=(tools/{codict,lexican}/src) with_tools=ON limits=(); }

# Configures the preset only: this determines the compiler options of each file, and nothing needs to be built.
lane() {
  (
    cd "$root" && cmake --preset development -DLEXICAN_TOOLS=$with_tools -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
      -DCMAKE_UNITY_BUILD=OFF
  ) >"$results/tidy.log" 2>&1 || { fail configuration "$results/tidy.log"; return; }
  local file logs=$results/tidy
  rm -rf "$logs" && mkdir -p "$logs"
  sources "${places[@]}" -name '*.cpp' -not -path '*/template/*' |
    xargs -P "$(nproc)" -I FILE bash -c '
      log=$1/$(tr / - <<<"$2").log
      clang-tidy-14 -p "$3" --quiet --warnings-as-errors="*" "${@:5}" "$4/$2" >"$log" 2>&1 && echo clean >>"$log"' \
      tidy "$logs" FILE "$build/development" "$root" "${limits[@]}"
  for file in $(sources "${places[@]}" -name '*.cpp' -not -path '*/template/*'); do
    check "$file" clean_log "$logs/${file//\//-}.log"
  done
}

clean_log() { [ "$(tail -n 1 "$1")" = clean ] || { grep -E 'warning:|error:' "$1" || cat "$1"; false; }; }
