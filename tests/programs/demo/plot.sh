#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# plot.sh LEXICAN-PLOT
#
# Checks the pictures of lexican-plot, its messages for malformed CSV, and the example of its help.
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
plot=$(realpath "${1:?lexican-plot}")
trap 'rm -r "$work"' EXIT

draw() { printf '%b' "$1" | "$plot"; }  # CSV
input="lexican-plot: standard input:"

ends "a curve in steps with title and axes" 0 "<svg *<title>value</title>*>10</text>*>30</text>*>0</text>*>12</text>*time in ms*\
id=\"curve\"*stroke=\"#0060C0\" d=\"M90,345h0H377.5V40H780V192.5\"/>*</svg>" draw '0;10\n5;30\n12;20\n'
ends "name, object, colour and trigger" 0 "*<title>a&lt;b &amp; c</title>*id=\"trigger\"*M435,40V345*>trigger<*stroke=\"#C00000\"*\
>a&lt;b &amp; c (2110h:00)</text>*" draw '# name: a<b & c\n# object: 2110h:00\n# colour: C00000\n# trigger: 5\n# any\n0;1\r\n10;-2\r\n'
ends "the time wraps" 0 "*M90,345h0H780V40*" draw '# trigger: 4294967291\n4294967290;1\n5;2'
ends "one point, the greatest value" 0 "*>4294967295</text>*time in ms*M90,345h0*" draw '7;4294967295'
ends "seconds" 0 "*>10</text>*time in s*" draw '0;0\n20000;1\n'
ends "hours" 0 "*>2.5</text>*time in h*" draw '0;0\n14400000;1\n'

ends "a line without separator" 1 "$input""2: no ';' in 'abc'; a line is 'time;value': *" draw '1;1\nabc\n'
ends "an empty line" 1 "$input""2: no ';' in ''; *" draw '1;1\n\n2;2\n'
ends "a wrong time" 1 "$input""1: wrong time '-1'; write milliseconds, *" draw '-1;1\n'
ends "a wrong value" 1 "$input""1: wrong value '4294967296'; write a number, *" draw '1;4294967296\n'
ends "a value with more behind it" 1 "$input""1: wrong value '2;3'; *" draw '1;2;3\n'
ends "a time before the previous one" 1 "$input""2: time 4 is before that of the previous point, 5; *" draw '5;1\n4;2\n'
ends "a wrong colour" 1 "$input""1: wrong colour 'red'; write six *" draw '# colour: red\n1;1\n'
ends "a wrong trigger" 1 "$input""1: wrong time of the trigger 'x'; *" draw '# trigger: x\n1;1\n'
ends "no points" 1 "lexican-plot: standard input: no points; read the plot *" draw '# name: speed\n'
ends "a missing file" 1 "lexican-plot: $work/none: cannot be opened; *" "$plot" "$work/none"
ends "an output that cannot be written" 1 "lexican-plot: $work/none/x.svg: cannot be written; *" \
  bash -c 'echo "1;1" | "$1" --output "$2/none/x.svg"' - "$plot" "$work"
ends "unknown option" 2 "lexican-plot: unknown option '--color'; see --help" "$plot" --color
ends "missing value" 2 "lexican-plot: option '--output' needs a file; see --help" "$plot" --output
ends "two files" 2 "lexican-plot: second file 'b'; see --help" "$plot" a b

# Runs the last line of the help.
mkdir "$work/bin" && ln -s "$plot" "$work/bin/lexican-plot"
ends "the example of the help" 0 "" bash -c 'cd "$2" && PATH=$2/bin:$PATH && eval "$("$1" --help | tail -n 1)" &&
  grep -q "<title>speed</title>" speed.svg' - "$plot" "$work"
finish
