#!/bin/busybox sh
# SPDX-License-Identifier: Apache-2.0
# demo/run of the guest, which cannot build the programs.
program=lexican-demo-node
[ "$1" != master ] || { program=lexican-demo-master && shift; }
exec $program "$@"
