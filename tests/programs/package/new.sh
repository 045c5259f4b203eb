#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# new.sh CODICT DIRECTORY SOURCE [LAUNCHER]
# Creates a project with CODICT (`codict new`) in DIRECTORY, builds it with the sources of Lexican in SOURCE, and runs its
# test. LAUNCHER: a compiler cache.
set -euo pipefail

codict=$1 directory=$2 source=$3
rm -rf "$directory"
mkdir -p "$directory"
cd "$directory"
"$codict" new drive --profile 402
cmake -S drive -B build -G Ninja -DLEXICAN="$source" -DLEXICAN_CODICT="$codict" -DCMAKE_BUILD_TYPE=Debug \
  ${4:+-DCMAKE_C_COMPILER_LAUNCHER=$4 -DCMAKE_CXX_COMPILER_LAUNCHER=$4}
cmake --build build
ctest --test-dir build --output-on-failure
build/drive_node | tee output
grep -E 'ms  node    701  00  boot-up$' output
grep -E 'ms  node    181  40 00 00 00 00 00  TPDO 1$' output
# The build has not changed what `codict new` generated.
"$codict" gen drive/drive.eds -o drive/generated --check
