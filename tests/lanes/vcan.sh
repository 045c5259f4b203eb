# SPDX-License-Identifier: Apache-2.0
about="the demo node and master on a real SocketCAN bus: a Debian kernel in QEMU; can-utils and python-can, too"
packages=("${build_packages[@]}" qemu-system-x86=qemu-system-x86_64 can-utils=candump iproute2=ip busybox-static=busybox
  cpio kmod=modprobe python3 python3-can=/usr/lib/python3/dist-packages/can/interface.py)
optional=yes

lane() {
  build_preset release || return
  run_tap "$root/tests/system/vcan/run" "$build/release/demo/linux_node/lexican-demo-node" \
    "$build/release/demo/linux_master/lexican-demo-master" "$build/release/tests/lexican_tests"
}
