# SPDX-License-Identifier: Apache-2.0
. "$root/tests/lanes/sizes.sh"
about="flash and RAM of the switches of co_cfg.h; compared with docs/sizes.md"
minutes=2
packages=(cmake ninja-build=ninja python3 "${arm_packages[@]}")
of=$results/switches

switches=(USE_CALLBACKS=0 USE_DICT_CHECK=0 USE_FAST_PATHS=0 USE_CSDO=0 USE_SDO_BLOCK=0 CO_CSDO_BLOCK=0
  USE_CSDO_OWN=0 CO_RPDO_N=0 CO_TPDO_N=0 USE_PDO_BITS=1 USE_PDO_RTR=0 CO_MPDO_N=16 USE_OD=1 USE_SYNC=0 USE_TIME=1
  USE_TIME=1+USE_TIME_HIGH_RES=1
  USE_GFC=1 CO_SRDO_N=1 USE_EMCY=0 CO_EMCY_QUEUE_N=0 CO_EMCY_CONS_N=1 CO_HBCONS_N=0 USE_GUARDING=0 USE_NMT_MASTER=1
  USE_LED=1 USE_LSS=0 USE_LSS_MASTER=1 USE_PARA=0 USE_RECORDER=1 USE_REAL_TIME=1)

lane() {
  local targets=(lexican "${switches[@]/#/lexican_}")
  targets=("${targets[@]//[=+]/_}")
  choose_cpu m0plus
  build_m0plus -DLEXICAN_SIZES=ON -DLEXICAN_SWITCHES="$(IFS=';'; echo "${switches[*]}")" && size_of_switches || return
  report switches "switch" --percent 1 --slack 32 \
    --column "flash" "$arm" "$of-flash" --column "RAM" "$arm" "$of-ram"
}

# Stores the difference in size of each switch's other value to presets/slave.h, with all functions kept.
size_of_switches() {
  local switch before after name
  rm -f "$of-flash" "$of-ram"
  before=($(size_with m0plus/lexican_slave)) || return
  for switch in "${switches[@]}"; do
    # shellcheck disable=SC2086
    after=($(size_with "m0plus/lexican_${switch//[=+]/_}" -D${switch//+/ -D})) || return
    name=${switch//=/ }
    printf '%s\t%d\n' "${name//+/, }" $((after[0] - before[0])) >>"$of-flash"
    printf '%s\t%d\n' "${name//+/, }" $((after[1] - before[1])) >>"$of-ram"
  done
}

size_with() {  # TREE/LIBRARY FLAG...: prints the bytes of flash and of RAM
  local program=$build/$1-node
  compile_c memory.c "$program.o" -DMAIN "${@:2}" >"$of.log" 2>&1 &&
    link_node "$1" "$program" yes -fno-lto ||
    { fail "link with $1" "$of.log" >&2; return 1; }
  local linked alone
  linked=($(bytes_of "$program")) alone=($(bytes_of "$program.o"))
  echo "${linked[0]} ${alone[1]}"
}
