# SPDX-License-Identifier: Apache-2.0
about="the demo node and master on a real SocketCAN bus: a Debian kernel in QEMU; also with can-utils and python-can; the bus tool lexican; SJA1000 on QEMU's cards"
minutes=3
packages=("${build_packages[@]}" "${tool_packages[@]}" "${arm_packages[@]}" qemu-system-x86=qemu-system-x86_64 can-utils=candump iproute2=ip busybox-static=busybox
  cpio kmod=modprobe python3 python3-can=/usr/lib/python3/dist-packages/can/interface.py)
optional=yes
waiting=yes

lane() {
  local codict demo targets=(lexican_bus_tests driver_check_socketcan lexican_sja1000_card)
  host_demo && build_preset release || return
  bus_tool || return
  heater >"$results/heater.log" 2>&1 || { fail "build of demo/heater" "$results/heater.log"; return; }
  python3 "$root/tests/programs/commands/commands.py" "$root" vcan >"$results/vcan.commands"  # in place of run_pages
  run_tap "$root/tests/drivers/vcan/run" "$demo/linux_node/lexican-demo-node" "$demo/linux_master/lexican-demo-master" \
    "$build/release/tests/lexican_bus_tests" "$build/release/tests/drivers/driver_check/driver_check_socketcan" \
    "$build/release/tests/lexican_sja1000_card" "$build/heater/heater" \
    "$demo/srdo/lexican-demo-srdo" "$results/vcan.commands" "$build/demo/tools/lexican/lexican"
}

# Builds the tool with gcc as users of demo/run do, for lane demo, too.
bus_tool() {
  local log=$results/vcan-tool.log
  now "building the bus tool"
  CFLAGS=-Werror CXXFLAGS=-Werror "$root/demo/run" lexican --version >"$log" 2>&1 || { fail "demo/run lexican" "$log"; return 1; }
}

# Builds as docs/start/4-from-an-eds.md describes, with the codict that a project for another machine has built.
heater() {
  host_codict && cmake -S "$root/demo/heater" -B "$build/heater" -G Ninja -DLEXICAN_CODICT="$codict" \
    -DLEXICAN_WARNINGS_AS_ERRORS=ON &&
    cmake --build "$build/heater"
}
