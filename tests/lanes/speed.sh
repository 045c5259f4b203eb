# SPDX-License-Identifier: Apache-2.0
about="duration of SDO transfers on a simulated bus; compared with docs/speed.md"
minutes=1
packages=("${build_packages[@]}")

# Measures the time of the simulated bus, which is the same on every machine.
lane() {
  local targets=(lexican_speed)
  build_preset release || return
  local program=$build/release/tests/numbers/speed/lexican_speed page=$root/docs/speed.md
  [ -z "${update_numbers:-}" ] || "$program" --update "$page" || fail "the table is not written"
  run_tap "$program" --check "$page"
}
