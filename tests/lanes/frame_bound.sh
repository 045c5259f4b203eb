# SPDX-License-Identifier: Apache-2.0
about="maximum instructions per frame in the committed inputs of the fuzz targets and in sweeps; compared with docs/speed.md"
minutes=1
packages=(cmake ninja-build=ninja "${arm_packages[@]}" qemu-system-arm python3)

lane() {
  local of=$results/frame_bound target measured=()
  build_tree frame_bound -DLEXICAN_FRAME_BOUND=ON -DLEXICAN_TESTS=OFF -DLEXICAN_DEMO=OFF -DLEXICAN_DRIVERS=OFF \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/arm-none-eabi.cmake" -DLEXICAN_CPU=cortex-m3 \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo || return
  for target in node sdo_client sdo_server sweep; do
    timeout 300 qemu-system-arm -M mps2-an385 -display none -monitor none -serial none -chardev stdio,id=host \
      -semihosting-config enable=on,target=native,chardev=host -icount shift=10 \
      -kernel "$build/frame_bound/tests/frame_bound/${target}_frame_bound" >"$of-$target" 2>&1 ||
      { fail "the target $target" "$of-$target"; return; }
    measured+=("$of-$target")
  done
  worst_of "${measured[@]}" >"$of"
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/frame_bound/bounds.txt" \
    --page "$root/docs/speed.md" --table frame_bound --title frame --remark "the worst" --percent 5 \
    --column "instructions" "arm-none-eabi-g++ $(arm-none-eabi-g++ -dumpfullversion)" "$of"
}

# Prints the line with the largest number for each name, in the order of the first file.
worst_of() {  # FILE...
  awk -F '\t' '/^#/ { next } !($1 in most) { names[++number] = $1 } $2 > most[$1] + 0 { most[$1] = $2; line[$1] = $0 }
    END { for (n = 1; n <= number; ++n) print line[names[n]] }' "$@"
}
