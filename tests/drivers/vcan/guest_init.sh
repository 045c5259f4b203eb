#!/bin/busybox sh
# SPDX-License-Identifier: Apache-2.0
# /init of the guest: vcan0 and can0, then the test.
export PATH=/bin:/usr/bin:/applets HOME=/tmp
/bin/busybox mkdir -p /applets
/bin/busybox --install -s /applets

mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mount -t tmpfs tmp /tmp
mkdir -p /dev/pts
mount -t devpts pts /dev/pts
# The kernel does not use the second PCI card.
echo 0 >/sys/bus/pci/drivers_autoprobe
while read -r module; do insmod "/modules/$module"; done </modules/order
# Called by their paths, as busybox's ip does not support CAN.
/bin/ip link set lo up
/bin/ip link add dev vcan0 type vcan
/bin/ip link set vcan0 txqueuelen 1000 up
echo 0000:00:10.0 >/sys/bus/pci/drivers/kvaser_pci/bind
/bin/ip link set can0 txqueuelen 1000 up type can bitrate 500000
echo 1 >/sys/bus/pci/devices/0000:00:11.0/enable

sh /test
echo "guest done"
poweroff -f
