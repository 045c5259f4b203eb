# SPDX-License-Identifier: Apache-2.0
about="the demo node on a real SocketCAN bus: a Debian kernel in QEMU, driven by can-utils"
packages=("${build_packages[@]}" qemu-system-x86=qemu-system-x86_64 can-utils=candump iproute2=ip busybox-static=busybox
  cpio kmod=modprobe python3)
optional=yes

lane() {
  build_preset release || return
  run_tap "$root/tests/system/vcan/run" "$build/release/demo/linux_node/lexican-demo-node" \
    "$build/release/tests/lexican_tests"
}
