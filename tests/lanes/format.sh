# SPDX-License-Identifier: Apache-2.0
about="clang-format, the licence line of each source, and the language of comments and test names"
minutes=1
packages=(clang-format-14 python3)

lane() {
  check "clang-format" formatted
  check "licence lines" licensed
  run_tap python3 "$root/tests/lanes/language.py" "$root"
  run_tap python3 "$root/tests/lanes/language.py" --self-test
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
