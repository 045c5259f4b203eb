#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests the HTML page of `codict doc` in a browser: page_test.sh CODICT FIXTURES. Prints TAP.
set -uo pipefail

codict=$1 fixtures=$2
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
number=0

report() {  # WHAT WANTED FOUND
  number=$((number + 1))
  if [ "$2" = "$3" ]; then
    echo "ok $number - $1"
  else
    echo "not ok $number - $1: $3, not $2"
  fi
}

# open_page NAME [SEARCH]: opens a page and stores its DOM after the script has run.
open_page() {
  timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$place/profile" --enable-logging=stderr \
    --dump-dom "file://$place/$1.html${2:+?q=$2}" >"$place/dom" 2>"$place/log"
}
count() { grep -o "$1" "$place/dom" | wc -l; }
shown_objects() { grep -o '<section class="object"[^>]*>' "$place/dom" | grep -vc hidden; }
script_errors() { grep -c 'CONSOLE.*\(Uncaught\|Error\)' "$place/log"; }

"$codict" doc "$fixtures/drive.eds" -o "$place/drive.html" || exit 1
sed 's/^show();$/nonsense();/' "$place/drive.html" >"$place/broken.html"

echo "1..14"
open_page drive
report "all objects are shown" 11 "$(shown_objects)"
report "no error of the script" 0 "$(script_errors)"
# A box for each byte: 8 + 16 bits of the RPDO, 32 + 8 of the TPDO.
report "the pictures of the PDOs have their boxes" 8 "$(count '<g class="part"')"
open_page drive wanted
report "a search finds an object by its name" 1 "$(shown_objects)"
report "and says so" 1 "$(count '1 of 11 objects')"
open_page drive encoder
report "a search finds a sub-object" 1 "$(shown_objects)"
report "and hides the others of its object" 1 "$(count '<tr id="o-2001-0" hidden')"
open_page drive nowhere
report "a search finds nothing where nothing is" 0 "$(shown_objects)"
open_page broken
report "an error of the script would be noticed" 1 "$(script_errors)"

# measure NAME WIDTH: counts the pixels of a page beyond a width, and the descriptions shown in two lines. The page is
# in a frame because windows have a minimum width.
measure() {
  cat >"$place/frame.html" <<END
<body><iframe id="frame" style="width:$2px;height:800px;border:0" src="$1.html"></iframe><script>
window.onload = () => {
  const page = document.getElementById('frame').contentDocument;
  const cells = Array.from(page.querySelectorAll('td, p'), cell => cell.innerText);
  document.body.dataset.beyond = page.documentElement.scrollWidth - page.documentElement.clientWidth;
  document.body.dataset.lines = cells.filter(text => text.includes('What it is,\\nin two lines.')).length;
};
</script></body>
END
  timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$place/profile" --allow-file-access-from-files \
    --enable-logging=stderr --dump-dom "file://$place/frame.html" >"$place/dom" 2>"$place/log"
}
of_frame() { grep -o "data-$1=\"[0-9]*\"" "$place/dom" | grep -o '[0-9]*'; }

measure drive 400
report "at 400 pixels, nothing has to be scrolled sideways" 0 "$(of_frame beyond)"
measure drive 1200
report "nor at 1200 pixels" 0 "$(of_frame beyond)"
# A name without blanks, as long as an EDS permits.
long=$(printf 'x%.0s' {1..240})
"$codict" set "$fixtures/drive.eds" 0x2000 "name=$long" -o "$place/long.eds" && "$codict" doc "$place/long.eds" -o "$place/long.html"
measure long 400
report "at 400 pixels, long words are broken" 0 "$(of_frame beyond)"
"$codict" doc "$fixtures/xdd/device10.xdd" -o "$place/lines.html"
measure lines 1200
report "line breaks of a description are shown" 1 "$(of_frame lines)"
measure lines 400
report "and the page of an XDD has no sideways scrolling" 0 "$(of_frame beyond)"
