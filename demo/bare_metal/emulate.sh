# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Packages, build and run commands of the bare-metal demo for its boards. The caller must set $root.

boards=(microbit mps2-an385 mps2-an386 virt)

is_board() { [[ " ${boards[*]} " == *" $1 "* ]]; }

board_packages() {  # BOARD: PACKAGE[=PROBE]..., one a line (cmake/install_packages.sh)
  printf '%s\n' cmake ninja-build=ninja gcc-arm-none-eabi=arm-none-eabi-g++ \
    libnewlib-arm-none-eabi=/usr/lib/arm-none-eabi/newlib/libc.a \
    libstdc++-arm-none-eabi-newlib=/usr/lib/arm-none-eabi/newlib/libstdc++.a
  if [ "$1" = virt ]; then
    printf '%s\n' gcc-riscv64-unknown-elf=riscv64-unknown-elf-g++ \
      picolibc-riscv64-unknown-elf=/usr/lib/picolibc/riscv64-unknown-elf/picolibc.specs \
      qemu-system-misc=qemu-system-riscv32
  else
    echo qemu-system-arm
  fi
}

toolchain() {  # BOARD: arguments for CMake, one a line
  local place=-DCMAKE_TOOLCHAIN_FILE=$root/cmake/toolchains
  case $1 in
    microbit) printf '%s\n' "$place/arm-none-eabi.cmake" -DLEXICAN_CPU=cortex-m0 ;;
    mps2-an385) printf '%s\n' "$place/arm-none-eabi.cmake" -DLEXICAN_CPU=cortex-m3 ;;
    mps2-an386) printf '%s\n' "$place/arm-none-eabi.cmake" -DLEXICAN_CPU=cortex-m4 -DLEXICAN_FLOAT_ABI=hard ;;
    virt) printf '%s\n' "$place/riscv32-none-elf.cmake" ;;
  esac
}

build_board() {  # BOARD DIRECTORY TARGET...: the programs are then in DIRECTORY/demo/bare_metal
  local arguments
  mapfile -t arguments < <(toolchain "$1")
  cmake -S "$root" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel -DLEXICAN_PRESET=slave -DLEXICAN_TESTS=OFF \
    -DLEXICAN_INSTALL=OFF -DLEXICAN_DEMO=ON "-DLEXICAN_BOARD=$1" "${arguments[@]}" &&
    cmake --build "$2" --target "${@:3}"
}

machine() {  # BOARD: QEMU's command
  if [ "$1" = virt ]; then
    echo qemu-system-riscv32 -M virt -bios none
  else
    echo qemu-system-arm -M "$1"
  fi
}

# Runs a program without a bus until it ends; its clock counts executed instructions: run_alone BOARD PROGRAM
run_alone() {
  local qemu
  read -ra qemu <<<"$(machine "$1")"
  "${qemu[@]}" -display none -monitor none -serial none -semihosting-config enable=on,target=native -icount shift=5 \
    -kernel "$2"
}

# Runs COMMAND -i slcan:SOCKET with a board: with_board BOARD PROGRAM COMMAND... The board starts when COMMAND has opened
# the socket, and is stopped when COMMAND has ended. Prints the board's error messages. The board's clock counts
# executed instructions, and follows real time only while the CPU sleeps: a node that a busy machine delays does not
# time out.
with_board() (
  read -ra qemu <<<"$(machine "$1")"
  program=$2
  shift 2
  place=$(mktemp -d)
  trap 'kill "$emulator" 2>/dev/null; wait "$emulator" 2>/dev/null; rm -r "$place"' EXIT
  "${qemu[@]}" -display none -monitor none -semihosting-config enable=on,target=native -icount shift=3 \
    -chardev "socket,id=can,path=$place/can,server=on,wait=on" -serial chardev:can -kernel "$program" \
    >"$place/log" 2>&1 &
  emulator=$!
  await_socket "$place/can" "$emulator"
  "$@" -i "slcan:$place/can"
  status=$?
  grep -v 'info: QEMU waiting for connection' "$place/log" >&2
  exit $status
)

# Runs the board with its UART at a Unix socket, to which programs can connect one after the other. It replaces the
# calling shell, so call it in the background: serve_board BOARD PROGRAM SOCKET &
serve_board() {
  local qemu
  read -ra qemu <<<"$(machine "$1")"
  exec "${qemu[@]}" -display none -monitor none -semihosting-config enable=on,target=native -icount shift=3 \
    -chardev "socket,id=can,path=$3,server=on,wait=off" -serial chardev:can -kernel "$2"
}

await_socket() {  # SOCKET PID-OF-THE-EMULATOR
  while [ ! -S "$1" ] && kill -0 "$2" 2>/dev/null; do
    sleep 0.05
  done
}
