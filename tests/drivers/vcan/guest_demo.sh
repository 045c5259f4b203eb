#!/bin/busybox sh
# SPDX-License-Identifier: Apache-2.0
# demo/run of the guest, which cannot build the programs.
program=lexican-demo-node
case $1 in master | srdo) program=lexican-demo-$1 && shift ;; esac
exec $program "$@"
