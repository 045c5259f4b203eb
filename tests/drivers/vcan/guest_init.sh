#!/bin/busybox sh
# SPDX-License-Identifier: Apache-2.0
# /init of the guest: vcan0, then the test.
export PATH=/bin:/usr/bin:/applets HOME=/tmp
/bin/busybox mkdir -p /applets
/bin/busybox --install -s /applets

mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mount -t tmpfs tmp /tmp
mkdir -p /dev/pts
mount -t devpts pts /dev/pts
while read -r module; do insmod "/modules/$module"; done </modules/order
# Called by their paths, as busybox's ip does not support CAN.
/bin/ip link set lo up
/bin/ip link add dev vcan0 type vcan
/bin/ip link set vcan0 txqueuelen 1000 up

sh /test
echo "guest done"
poweroff -f
