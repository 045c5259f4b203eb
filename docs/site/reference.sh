#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# reference.sh ROOT OUT [HEADER...]: makes the API reference in OUT/html, and OUT/tags.xml, which names its pages. Fails
# for a header or public symbol without comment, also among the internals that have no page, and for a \retval or \param
# that does not begin its line. HEADER: only checks these headers, instead of those of the Doxyfile.
set -euo pipefail

root=$1
out=$2
shift 2
cd "$root"
mkdir -p "$out"
rm -rf "$out/xml"

run_doxygen() {  # SETTING...
  { cat docs/site/Doxyfile && printf '%s\n' "OUTPUT_DIRECTORY = \"$out\"" "$@"; } | doxygen -
}

# The formatter joins the lines of a list with a text in front of it.
headers=("$@")
[ $# -gt 0 ] || headers=(include config drivers)
if grep -rnE --include='*.h' --include='*.hpp' '///.*[^ /<].*\\(retval|param)' "${headers[@]}" >&2; then
  echo "error: \retval or \param within a line: begin a new line for each" >&2
  exit 1
fi

run_doxygen GENERATE_HTML=NO GENERATE_XML=YES EXTRACT_ALL=YES EXCLUDE= EXCLUDE_SYMBOLS= ${1:+INPUT="$*"}
docs/site/undocumented.py "$out/xml"
[ $# -gt 0 ] || run_doxygen GENERATE_TAGFILE="$out/tags.xml"
