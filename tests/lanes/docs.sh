# SPDX-License-Identifier: Apache-2.0
about="the documentation site: builds without warnings, comments for every symbol of the headers, valid links, no content from other hosts, pages drawn by Chromium"
minutes=2
packages=(mkdocs mkdocs-material=/usr/share/mkdocs/themes/material/mkdocs_theme.yml graphviz=dot doxygen python3 chromium)
# Pages of the API reference that are drawn: one of each kind.
reference_pages=(index co__core_8h co__csdo_8h co__cfg_8h co__od_8h namespaceco structCO__NODE__T classco_1_1VirtualBus files)

lane() {
  local site=$build/site
  check "the site builds without a warning" "$root/docs/run" --build || return
  check "a port in use is refused in one line" port_in_use_is_refused
  run_tap python3 "$root/docs/site/check.py" "$site/html"
  run_tap python3 "$root/tests/programs/commands/commands.py" "$root"
  check "found: a command that no lane runs" unrun_command
  run_tap python3 "$root/tests/programs/porting/excerpts.py" "$root" docs/index.md
  check "the first page has the numbers of docs/sizes.md and docs/speed.md" first_page_has_numbers
  check "found: a page that loads from elsewhere" planted '<script src="https://example.org/a.js"></script>'
  check "found: a link that leads nowhere" planted '<a href="../nowhere/">nowhere</a>'
  check "found: a search that leads nowhere" planted '{"docs": [{"location": "reference/a.html#b"}]}' search_index.json
  check "the API reference accepts a documented header" reference '/// \file planted.hpp' '/// A header.' '' \
    'int a();  ///< returns 0'
  check "found: a header without comment" undocumented '/// A function.' 'int a();'
  local symbol
  for symbol in 'int a();' 'namespace co { int a(); }' 'namespace co { inline constexpr int a = 1; }' '#define A 1' \
    'struct A {};' 'typedef int A;' $'/// A\nstruct A { int a; };' $'/// A\nclass A { public: int a(); };' \
    $'/// A\nenum A { a };'; do
    check "found: no comment in: ${symbol//$'\n'/ }" undocumented '/// \file planted.hpp' '/// A header.' '' "$symbol"
  done
  check "found: a function without list of results" refused_reference ' has no list of ' '/// \file planted.h' \
    '/// A header.' '' '/// A function.' 'CO_ERR a();'
  check "a list of results is accepted" reference_of planted.h '/// \file planted.h' '/// A header.' '' '/// A function.' \
    '/// \retval CO_ERR_NONE  success' 'CO_ERR a();'
  check "found: a result within a line" refused_reference ' within a line' '/// \file planted.h' '/// A header.' '' \
    '/// A function. \retval CO_ERR_NONE  success' '/// \retval CO_ERR_BAD_ARG  an argument' 'CO_ERR a();'
  draw_planted_pages
  rm -rf "$results/site"
  local pages=("${reference_pages[@]/%/.html}")
  run_tap "$root/docs/site/screenshots.py" "$site/html" "$results/site" "${pages[@]/#/reference/}"
}

# The build of the site fills the table of docs/index.md: no cell is empty, and one has the committed number.
first_page_has_numbers() {
  local page=$build/site/html/index.html number
  number=$(sed -n 's/^slave with the features of the others, flash of the stack alone | \([0-9]*\) .*/\1/p' "$root/tests/numbers/sizes/nodes.txt")
  ! grep '<td[^>]*></td>' "$page" && tr -d '\342\200\257' <"$page" | grep "<td[^>]*>$number</td>"
}

port_in_use_is_refused() {
  python3 - "$root/docs/run" <<'END'
import socket
import subprocess
import sys

with socket.create_server(("127.0.0.1", 0)) as server:
    port = server.getsockname()[1]
    run = subprocess.run([sys.argv[1], "--port", str(port)], capture_output=True, text=True)
print(run.stdout + run.stderr)
sys.exit(run.returncode != 1 or run.stderr.count("\n") != 1 or f"port {port} is in use" not in run.stderr)
END
}

# Draws a good page and faulty ones: the faults must be found.
draw_planted_pages() {
  drawn=$results/planted-pages.log
  rm -rf "$results/planted-pages"
  mkdir -p "$results/planted-pages"
  plant_page good '<main><p>A page</p><pre style="overflow: auto">'"$(printf 'x%.0s' {1..400})"'</pre></main>'
  plant_page wide '<main><p style="width: 500px">wide</p></main>'
  plant_page cut '<main style="overflow: hidden"><p style="width: 500px">wide</p></main>'
  plant_page missing '<main><p>A page</p><img src="missing.png"></main>'
  plant_page small '<main><p>A page</p><img src="picture.svg" style="width: 0"></main>'
  plant_page script '<main><p>A page</p><script>nonsense();</script></main>'
  plant_page blank '<main></main>'
  echo '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>' >"$results/planted-pages/picture.svg"
  "$root/docs/site/screenshots.py" "$results/planted-pages" "$results/planted-site" nowhere.html >"$drawn" 2>&1
  check "a good page is accepted" grep -x 'ok good.html at 400 pixels' "$drawn"
  check "a page that fits into a wide window is accepted" grep -x 'ok wide.html at 1280 pixels' "$drawn"
  check "found: a page that scrolls sideways" found_in wide 'scrolls sideways: its width is 5.. pixels'
  check "found: contents that are cut off" found_in cut 'p is cut off'
  check "found: a missing picture" found_in missing 'missing.png is not loaded'
  check "found: a picture without size" found_in small 'picture.svg has no size'
  check "found: an error of a script" found_in script 'nonsense is not defined'
  check "found: an empty page" found_in blank 'is empty'
  check "found: a page that does not exist" found_in nowhere 404
}

plant_page() { printf '<!DOCTYPE html><title>%s</title>%s\n' "$1" "$2" >"$results/planted-pages/$1.html"; }  # NAME HTML

found_in() { grep "^not ok $1.html at 400 pixels: .*$2" "$drawn"; }  # PAGE FAULT

# Makes the API reference of a header.
reference() { reference_of planted.hpp "$@"; }  # LINE...

reference_of() {  # NAME LINE...
  printf '%s\n' "${@:2}" >"$results/$1"
  "$root/docs/site/reference.sh" "$root" "$results/reference" "$results/$1"
}

refused_reference() {  # TEXT LINE...
  local said
  ! said=$(reference_of planted.h "${@:2}" 2>&1) && grep -- "$1" <<<"$said"
}

undocumented() {  # LINE...
  local said
  ! said=$(reference "$@" 2>&1) && grep ' has no comment$' <<<"$said"
}

unrun_command() {
  local pages=$results/planted-commands
  rm -rf "$pages"
  mkdir -p "$pages/tests/programs/commands"
  printf '%s\n' '```sh' 'make nothing' '```' >"$pages/page.md"
  echo 'is run by hand | make something' >"$pages/tests/programs/commands/commands_not_run.txt"
  ! python3 "$root/tests/programs/commands/commands.py" "$pages" >"$pages/said" &&
    grep '^not ok page.md: make nothing: no lane runs it' "$pages/said" &&
    grep '^not ok commands_not_run.txt: make something: no page has this command' "$pages/said"
}

planted() {  # TEXT [FILE]
  rm -rf "$results/site-planted"
  mkdir -p "$results/site-planted"
  echo "$1" >"$results/site-planted/${2:-index.html}"
  ! python3 "$root/docs/site/check.py" "$results/site-planted"
}
