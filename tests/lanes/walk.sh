# SPDX-License-Identifier: Apache-2.0
about="functions that operations call, at -O0; compared with tests/walk/walks.txt and docs/design.md"
minutes=1
. "$root/tests/lanes/library.sh"
packages=(g++ cmake ninja-build=ninja python3 binutils=nm)

lane() {
  local targets=(lexican_walk)
  build_library walk -O3 -DLEXICAN_WALK=ON -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc || return
  local compiler
  compiler="g++ $(g++ -dumpfullversion)"
  grep -q "^# $compiler$" "$root/tests/walk/walks.txt" || [ -n "$update_numbers" ] ||
    { skip "walks: walks.txt is of another compiler than $compiler"; return; }
  run_tap python3 "$root/tests/walk/walk.py" ${update_numbers:+--update} --compiler "$compiler" \
    --program "$build/walk/tests/walk/lexican_walk" --committed "$root/tests/walk/walks.txt" --page "$root/docs/design.md"
}
