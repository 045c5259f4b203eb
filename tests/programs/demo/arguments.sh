#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# arguments.sh NODE MASTER THERMOMETER RECORDER SRDO
#
# Checks that demo/run checks its arguments and shows its help before it installs or builds anything, that the commands
# in README.md are valid, and that the help texts have the options of the programs.
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
node=${1:?the demo node} master=${2:?the demo master} thermometer=${3:?the thermometer} recorder=${4:?the recorder} srdo=${5:?the SRDO demo}
trap 'rm -r "$work"' EXIT

# Replacements of the tools that install and build, which record their arguments.
mkdir "$work/bin"
for tool in apt-get sudo cmake ninja g++; do
  printf '#!/bin/sh\necho "%s $*" >>"%s"\nexit 1\n' "$tool" "$work/called" >"$work/bin/$tool"
  chmod +x "$work/bin/$tool"
done
checked() { PATH=$work/bin:$PATH "$root/demo/run" "$@"; }

answers() {  # CASE STATUS PATTERN [ARGUMENT]...: without any of the tools
  rm -f "$work/called"
  ends "$1" "$2" "$3" checked "${@:4}"
  [ ! -e "$work/called" ]
  verdict $? "$1: nothing is installed or built" "$(cat "$work/called" 2>/dev/null)"
}

answers "help" 0 "Usage: demo/run *--bare-metal*--serve*" --help
answers "help of the master" 0 "*--index HEX*nmt *" master --help
answers "help of lss" 0 "*--address V P R S*set-bitrate*" master lss --help
answers "help of the thermometer" 0 "*Usage: demo/run thermometer*" thermometer --help
answers "help of the recorder" 0 "*Usage: demo/run recorder*--output FILE*" recorder --help
answers "help of the SRDO demo" 0 "*Usage: demo/run srdo*--bus BUS*" srdo --help
answers "help of the boards" 0 "*mps2-an385*--serve*" --bare-metal --help

answers "unknown option" 2 "demo/run: unknown option '--frames' of the node*--every-frame*" --frames
answers "unknown option with a value" 2 "demo/run: unknown option '--id' of the node*" --id=5
answers "unknown program" 2 "demo/run: unknown program 'slave'; one of tour, lexican, master, thermometer*" slave
answers "the option without its dashes" 2 "demo/run: unknown program 'serve'; * demo/run --serve" serve
answers "a command without its program" 2 "demo/run: unknown program 'lss'; * demo/run master lss" lss scan
answers "missing value" 2 "demo/run: option '--node-id' of the node needs a value*" --serve --node-id
answers "unknown option of the master" 2 "demo/run: unknown option '--id' of master*--node N*--store*" master --id 5 read
answers "missing value of the master" 2 "demo/run: option '--address' of master needs 4 values*" master lss inquire --address 1 2 3
answers "missing command of the master" 2 "demo/run: master needs a command: read, write, nmt, lss or tour" master --node 5
answers "unknown command of the master" 2 "demo/run: unknown command 'get' of master*" master --node 5 get
answers "unknown NMT command" 2 "demo/run: nmt needs one of: start stop preop reset-node reset-comm" master nmt begin
answers "unknown LSS service" 2 "demo/run: lss needs one of: scan set-id set-bitrate store inquire" master lss find
answers "argument of the thermometer" 2 "demo/run: unknown argument '20' of thermometer*" thermometer 20
answers "argument of the recorder" 2 "demo/run: unknown argument 'x.csv' of recorder*" recorder x.csv
answers "argument of the SRDO demo" 2 "demo/run: unknown argument 'vcan0' of srdo*" srdo vcan0
answers "missing value of the recorder" 2 "demo/run: option '--output' of recorder needs a value*" recorder --output
answers "unknown board" 2 "demo/run: unknown board 'uno'; one of *" --bare-metal uno
answers "unknown option of a board" 2 "demo/run: unknown option '--virtual' of --bare-metal*" --bare-metal microbit --virtual
answers "several boards to be served" 2 "demo/run: --serve runs one board, not all" --bare-metal all --serve

# Checks the arguments of all commands in README.md, docs/demo.md and docs/use.md. Then the command fails, as the
# replaced tools cannot install missing packages.
readme_commands() { sed -nE 's/^(demo\/run( [^#]*)?)(#.*)?$/\1/p' "$root/README.md" "$root"/docs/{demo,use}.md | sed 's/ *&* *$//; s/ \[BOARD\]//'; }
count=0
while read -r command; do
  count=$((count + 1))
  read -ra words <<<"$command"
  output=$(checked "${words[@]:1}" 2>&1 </dev/null)
  [[ $output != "demo/run: "* ]]
  verdict $? "documented: $command" "$output"
done < <(readme_commands)
[ $count -ge 9 ]
verdict $? "the pages have commands of the demo" "$count found"

# Checks that the help texts and the programs have the same options, with the same number of values.
. <(sed -n '/^options_of()/,/^}/p' "$root/demo/run")
same_options() {  # HELP COMMAND...
  "${@:2}" --help >"$work/help"
  ends "options in demo/help/$1" 0 "" diff <(help=$root/demo/help options_of "$1") <(help=$work options_of help)
}
same_options node.txt "$node"
same_options master.txt "$master"
same_options lss.txt "$master" lss
same_options thermometer.txt "$thermometer"
same_options recorder.txt "$recorder"
same_options srdo.txt "$srdo"

# Checks that missing packages are named with their size before they are installed.
ends "missing packages" 0 "missing Debian packages: sl
installing them and what they need: 23 packages, 45.2 MB to download, 1,201 MB on disk" bash -c '
  . "$1/cmake/install_packages.sh"
  as_root() { "$@"; }
  apt-get() {
    echo "0 upgraded, 23 newly installed, 0 to remove and 1 not upgraded."
    echo "Need to get 45.2 MB of archives."
    echo "After this operation, 1,201 MB of additional disk space will be used."
    echo "Abort."
  }
  apt_install() { return 0; }
  probe_found() { return 1; }
  install_packages sl' - "$root"
ends "progress of a long command" 3 "building the demo: 15 s, 12 of 89*" bash -c '
  . "$1/cmake/progress.sh"
  work=$2
  unset SECONDS  # a variable that only sleep advances
  SECONDS=0
  sleep() {
    until [ -s "$work/log" ]; do command sleep 0.02; done
    [ $((SECONDS += 1)) -le 15 ] || : >"$work/shown"
    command sleep 0.02
  }
  build() {
    echo "[12/89] Building"
    until [ -e "$work/shown" ]; do command sleep 0.02; done
    return 3
  }
  with_progress "building the demo" "$work/log" build' - "$root" "$work"
finish
