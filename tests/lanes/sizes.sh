# SPDX-License-Identifier: Apache-2.0
about="flash and RAM of nodes, modules, drivers and each additional object, stack depth of functions; compared with docs/sizes.md"
minutes=2
packages=(cmake ninja-build=ninja python3 "${arm_packages[@]}" gcc-riscv64-unknown-elf=riscv64-unknown-elf-g++
  picolibc-riscv64-unknown-elf=/usr/lib/picolibc/riscv64-unknown-elf/lib/libc.a)

presets=(minimal fair slave full)
of=$results/sizes

lane() {
  local cpu preset
  for cpu in rv32 m4 m0plus; do
    choose_cpu $cpu
    build_library "sizes-$cpu" "-Os ${lto[*]}" -DLEXICAN_SIZES=ON -DLEXICAN_DRIVERS=$drivers "${configure[@]}" || return
    rm -f "$of-$cpu" "$of-$cpu-lto"
    for preset in "${presets[@]}"; do
      size_of_node $cpu "$preset" || return
    done
  done
  size_of_drivers || return
  sizes_of_one_file
  size_of_memory && size_of_things || return
  report_nodes
  report_modules
  report_memory
  report_things
  report_drivers
  self_test
  stack_depths
}

# Sets the tools for the functions below. The objects contain machine code and the data for link-time optimisation.
# Drivers are measured on one CPU.
choose_cpu() {  # CPU
  local core
  drivers=OFF
  case $1 in
    m0plus) tools=arm-none-eabi core=cortex-m0plus toolchain=arm-none-eabi drivers=ON ;;
    m4) tools=arm-none-eabi core=cortex-m4 toolchain=arm-none-eabi ;;
    rv32) tools=riscv64-unknown-elf core=rv32imac toolchain=riscv32-none-elf ;;
  esac
  case $1 in
    rv32) compile=($tools-gcc -march=$core -mabi=ilp32 --specs=picolibc.specs) specs=(-Wl,--defsym=__flash_size=0x100000) ;;
    *) compile=($tools-gcc -mcpu=$core -mthumb) specs=(--specs=nano.specs --specs=nosys.specs) ;;
  esac
  configure=(-DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$toolchain.cmake" -DLEXICAN_CPU=$core)
  compile+=(-Os -ffunction-sections -fdata-sections)
  lto=(-flto -ffat-lto-objects)
}

compile_c() {  # SOURCE OUTPUT FLAG...
  "${compile[@]}" -Wall -Werror -std=c11 -I "$root/include" -I "$root/config" -c "$root/tests/numbers/sizes/$1" -o "$2" "${@:3}"
}

preset_flag() {  # PRESET
  case $1 in
    fair) echo "-DCO_CFG_PRESET=\"$root/tests/numbers/sizes/fair.h\"" ;;
    *) echo "-DCO_CFG_PRESET=\"presets/$1.h\"" ;;
  esac
}

title_of() { if [ "$1" = fair ]; then echo "slave with the features of the others"; else echo "$1"; fi; }  # PRESET

size_of_node() {  # CPU PRESET
  local program=$build/sizes-$1/node-$2 smallest=0 everything=
  [ "$2" != minimal ] || smallest=1
  [ "$2" != full ] || everything=yes
  compile_c whole_node.c "$program.o" "$(preset_flag "$2")" -DNODE_IS_SMALLEST=$smallest "${lto[@]}" >"$of.log" 2>&1 &&
    link_node "sizes-$1/lexican_$2" "$program" "$everything" -fno-lto -Wl,-Map="$program.map" &&
    link_node "sizes-$1/lexican_$2" "$program" "$everything" -flto=2 -o "$program-lto" ||
    { fail "link of $2 for $1" "$of.log"; return 1; }
  python3 "$root/tests/numbers/sizes/modules.py" "$program.map" >"$of-$1-$2-modules" || return
  size_lines "$(title_of "$2")" "$program" "$(awk '/^all modules/ { print $NF }' "$of-$1-$2-modules")" >>"$of-$1"
  size_lines "$(title_of "$2")" "$program-lto" >>"$of-$1-lto"
  [ "$2" != minimal ] || size_with_classic_drivers "$1" "$2"
}

# Checks the library as one file, written afresh: without LTO a program is not larger than with the library, with LTO at
# most 1 % larger than with the library and LTO; a C program is linked without the C++ run time.
sizes_of_one_file() {
  local preset
  rm -rf "$build/one_file"
  python3 "$root/cmake/one_file.py" "$build/one_file" || return
  check "the library as one file, with the defaults of the compiler" "$tools-g++" -c -Wall -Wextra -Werror \
    "$build/one_file/lexican.cpp" -o "$of.o"
  for preset in minimal fair; do
    check "the library as one file, $preset" one_file_fits "$preset" "$build/sizes-m0plus/node-$preset"
    check "the library as one file, $preset with LTO" one_file_fits "$preset" "$build/sizes-m0plus/node-$preset-lto" \
      -flto=2 -fno-exceptions -fno-tree-loop-distribute-patterns
  done
}

one_file_fits() {  # PRESET PROGRAM FLAG...: compared with a program of the library
  local program=$build/one_file/$1 flash most
  "${compile[@]/%-gcc/-g++}" -Wall -Wextra -Werror "$(preset_flag "$1")" -I "$root/config" -c \
    "$build/one_file/lexican.cpp" -o "$program.o" "${@:3}" &&
    "${compile[@]}" "${specs[@]}" -o "$program" "${@:3}" "${2%-lto}.o" "$program.o" -nostartfiles -Wl,--gc-sections \
      -Wl,-e,main || return
  read -r flash _ < <(bytes_of "$program")
  read -r most _ < <(bytes_of "$2")
  [ $# -eq 2 ] || most=$((most * 101 / 100))
  echo "$flash bytes, at most $most"
  [ "$flash" -gt 0 ] && [ "$flash" -le "$most" ]
}

# The flash of the stack with adapters for classic drivers.
size_with_classic_drivers() {  # CPU PRESET
  local program=$build/sizes-$1/classic-$2
  compile_c whole_node.c "$program.o" "$(preset_flag "$2")" -DNODE_IS_SMALLEST=1 -DNODE_IS_CLASSIC=1 "${lto[@]}" \
    >"$of.log" 2>&1 && link_node "sizes-$1/lexican_$2" "$program" "" -fno-lto -Wl,-Map="$program.map" ||
    { fail "link of $2 with classic drivers for $1" "$of.log"; return 1; }
  printf '%s with classic drivers, flash of the stack alone\t%d\n' "$2" \
    "$(python3 "$root/tests/numbers/sizes/modules.py" "$program.map" | awk '/^all modules/ { print $NF }')" >>"$of-$1"
}

# Prints the objects of a library, in the order of their sources.
objects_of() {  # TREE/LIBRARY
  sed -n 's,/[.]/,/,; s,.*[.]dir/\(\(__/\)*src/\)*\(.*\),\3 &,p' "$build/$1.objects" | sort | cut -d ' ' -f 2
}

# Links a program. With EVERYTHING all functions that an application may call are kept.
link_node() {  # TREE/LIBRARY PROGRAM EVERYTHING FLAG...: links PROGRAM.o
  local objects keep=()
  mapfile -t objects < <(objects_of "$1")
  [ -z "$3" ] || mapfile -t keep < <("$tools-nm" -fposix "${objects[@]}" 2>/dev/null |
    awk '$1 ~ /^(CO|OD)/ && $2 ~ /^[TRD]$/ { print "-Wl,--undefined=" $1 }' | sort)
  "${compile[@]}" "${specs[@]}" -o "$2" "${@:4}" "$2.o" "${objects[@]}" "${keep[@]}" -nostartfiles -Wl,--gc-sections \
    -Wl,-e,main >"$of.log" 2>&1
}

size_of_drivers() {
  rm -f "$of-drivers" "$of-drivers-ram"
  driver "CAN: bxCAN" can/bxcan co_can_bxcan Bxcan CO_CAN_BXCAN &&
    driver "CAN: FDCAN" can/fdcan co_can_fdcan Fdcan CO_CAN_FDCAN &&
    driver "CAN: M_CAN" can/fdcan co_can_fdcan Mcan CO_CAN_FDCAN &&
    driver "CAN: FlexCAN" can/flexcan co_can_flexcan Flexcan CO_CAN_FLEXCAN &&
    driver "CAN: SJA1000" can/sja1000 co_can_sja1000 Sja1000 CO_CAN_SJA1000 &&
    driver "CAN: TWAI" can/sja1000 co_can_twai Twai CO_CAN_TWAI &&
    driver "CAN: MCP2515" can/mcp2515 co_can_mcp2515 Mcp2515 CO_CAN_MCP2515 &&
    driver "CAN: MCP251xFD" can/mcp251xfd co_can_mcp251xfd Mcp251xfd CO_CAN_MCP251XFD &&
    driver "CAN: ZynqMP" can/zynqmp co_can_zynqmp Zynqmp CO_CAN_ZYNQMP &&
    driver "CAN: slcan" can/slcan co_slcan Slcan CO_SLCAN &&
    driver "memory: flash_pages" nvm/flash_pages co_nvm_flash_pages FlashPages &&
    driver "memory: eeprom_i2c" nvm/eeprom_i2c co_nvm_eeprom_i2c EepromI2c &&
    driver "memory: eeprom_spi" nvm/eeprom_spi co_nvm_eeprom_spi EepromSpi &&
    driver "memory: ram" nvm/ram co_nvm_ram Ram CO_NVM_RAM &&
    driver "timer: stm32_tim" timer/stm32_tim co_timer_stm32_tim Stm32Tim CO_STM32_TIM &&
    driver "timer: SysTick" timer/tickless co_timer_systick SysTick CO_SYSTICK &&
    driver "timer: mtime" timer/tickless co_timer_mtime Mtime CO_MTIME &&
    driver "timer: nRF51" timer/tickless co_timer_nrf51 Nrf51 CO_NRF51_TIMER &&
    driver "timer: software" timer/software co_timer_software SoftwareTimer
}

# Links the source files of a driver whose public names match, those that they use, and a context.
driver() {  # NAME DIRECTORY HEADER NAMES [CONTEXT]
  local library=$build/sizes-m0plus/drivers/liblexican_${2/\//_}.a keep
  mapfile -t keep < <("$tools-nm" -fposix "$library" 2>/dev/null |
    awk -v of="$4" '$1 ~ of && $1 !~ /^_/ && $2 ~ /^[TRD]$/ { print "-Wl,--undefined=" $1 }')
  printf '#include "%s.h"\n%s\n' "$3" "${5:+$5 context;}" >"$of-driver.c"
  "${compile[@]}" -Wall -Werror -std=c11 -I "$root/include" -I "$root/config" -I "$root/drivers/${2%/*}" -I "$root/drivers/$2" \
    -c "$of-driver.c" -o "$of-context.o" >"$of.log" 2>&1 &&
    "${compile[@]/--specs=*/-r}" -r -nostdlib -fno-lto "${keep[@]}" "$of-context.o" "$library" \
      -o "$of-driver.o" >"$of.log" 2>&1 || { fail "link of the driver $1" "$of.log"; return 1; }
  "$tools-size" -A "$of-driver.o" | awk -v name="$1" -v file="$of-drivers" '
    $1 ~ /^[.]s?(text|rodata|data)/ { flash += $2 } $1 ~ /^[.]s?(data|bss)/ { ram += $2 }
    END { print name "\t" flash >>file; print name "\t" ram + 0 >>(file "-ram") }'
}

size_lines() {  # WHAT PROGRAM [BYTES-OF-ALL-MODULES]
  local flash ram
  read -r flash ram < <(bytes_of "$2")
  printf '%s, flash\t%d\n' "$1" "$flash"
  [ -z "${3:-}" ] || printf '%s, flash of the stack alone\t%d\n' "$1" "$3"
  printf '%s, RAM\t%d\n' "$1" "$ram"
}

# Prints the bytes of flash and of RAM, without those that a linker script reserves for the CPU's stack.
bytes_of() {  # OBJECT-OR-PROGRAM
  local reserved
  reserved=$("$tools-size" -A "$1" | awk '$1 == ".stack" { print $2 }')
  "$tools-size" "$1" | awk -v reserved="${reserved:-0}" 'NR == 2 { print $1 + $2, $2 + $3 - reserved }'
}

size_of_memory() {
  local preset
  for preset in "${presets[@]}"; do
    compile_c memory.c "$of.o" "$(preset_flag "$preset")" -DMODULES >"$of.log" 2>&1 ||
      { fail "memory of the modules, $preset" "$of.log"; return 1; }
    "$tools-nm" -fposix -td "$of.o" | awk '{ sub("module_", "", $1); print $1 "\t" $4 + 0; all += $4 }
      END { print "all modules\t" all }' >"$of-memory-$preset"
  done
}

# Prints the bytes of one more of a thing: the difference between a node with a number of it and one with 16 more,
# divided by 16.
size_of_things() {
  rm -f "$of-things-flash" "$of-things-ram"
  thing "dictionary entry" -DENTRIES=4 -- -DENTRIES=20 &&
    thing "object in the index of co_od.h" -DUSE_OD=1 -DOBJECTS=4 -- -DUSE_OD=1 -DOBJECTS=20 &&
    thing "timer of the application" -DTIMERS=4 -- -DTIMERS=20 &&
    thing "RPDO" -DCO_RPDO_N=4 -- -DCO_RPDO_N=20 &&
    thing "TPDO" -DCO_TPDO_N=4 -- -DCO_TPDO_N=20 &&
    thing "RPDO and TPDO" -DCO_RPDO_N=4 -DCO_TPDO_N=4 -- -DCO_RPDO_N=20 -DCO_TPDO_N=20 &&
    thing "RPDO and TPDO, with their 24 entries" -DCO_RPDO_N=4 -DCO_TPDO_N=4 -DENTRIES=4 -- \
      -DCO_RPDO_N=20 -DCO_TPDO_N=20 -DENTRIES=388 &&
    thing "RPDO and TPDO that can map single bits" -DUSE_PDO_BITS=1 -DCO_RPDO_N=4 -DCO_TPDO_N=4 -- \
      -DUSE_PDO_BITS=1 -DCO_RPDO_N=20 -DCO_TPDO_N=20 &&
    thing "SDO server without its buffer" -DWITHOUT_BUFFER -DCO_SSDO_N=4 -- -DWITHOUT_BUFFER -DCO_SSDO_N=20 &&
    thing "segment in the buffer of an SDO server" -DCO_SDO_BUF_SEG=4 -- -DCO_SDO_BUF_SEG=20 &&
    thing "SDO client" -DCO_CSDO_N=4 -- -DCO_CSDO_N=20 &&
    thing "heartbeat consumer, with its entry and value" -DCO_HBCONS_N=4 -DENTRIES=4 -DVALUES=4 -- \
      -DCO_HBCONS_N=20 -DENTRIES=20 -DVALUES=20 &&
    thing "EMCY consumer, with its entry and value" -DCO_EMCY_CONS_N=4 -DENTRIES=4 -DVALUES=4 -- \
      -DCO_EMCY_CONS_N=20 -DENTRIES=20 -DVALUES=20 &&
    thing "8 errors of the application" -DCO_EMCY_N=32 -- -DCO_EMCY_N=160 &&
    thing "EMCY message that waits" -DCO_EMCY_QUEUE_N=4 -- -DCO_EMCY_QUEUE_N=20 &&
    thing "place in the EMCY history, with its entry and value" -DENTRIES=4 -DVALUES=4 -- -DENTRIES=20 -DVALUES=20 &&
    thing "object of the scanner list and entry of the dispatching list" -DCO_MPDO_N=4 -- -DCO_MPDO_N=20 &&
    thing "object of error status bits, with its entry" -DERROR_BITS=4 -DENTRIES=4 -- -DERROR_BITS=20 -DENTRIES=20 &&
    thing "constant domain (1021h), with its entry" -DCONSTANT_DOMAINS=4 -DENTRIES=4 -- -DCONSTANT_DOMAINS=20 -DENTRIES=20 &&
    thing "OS command (1023h) with 5 entries, without its buffers" -DCOMMANDS=4 -DENTRIES=20 -- -DCOMMANDS=20 -DENTRIES=100 &&
    thing "OS prompt (1026h) with 4 entries, without its buffers" -DPROMPTS=4 -DENTRIES=16 -- -DPROMPTS=20 -DENTRIES=80 &&
    thing "frame that waits for the controller" -DCO_TX_QUEUE_N=4 -- -DCO_TX_QUEUE_N=20
}

thing() {  # NAME FLAG... -- FLAG...: with a number, with 16 more
  local name=$1 before=() after
  shift
  while [ "$1" != -- ]; do
    before+=("$1")
    shift
  done
  shift
  before=($(bytes_with "${before[@]}")) && after=($(bytes_with "$@")) || { fail "size of: $name" "$of.log"; return 1; }
  awk -v what="$name" "BEGIN { print what \"\\t\" (${after[0]} - ${before[0]}) / 16 }" >>"$of-things-flash"
  awk -v what="$name" "BEGIN { print what \"\\t\" (${after[1]} - ${before[1]}) / 16 }" >>"$of-things-ram"
}

bytes_with() {  # FLAG...: of memory.c
  compile_c memory.c "$of.o" "$@" >"$of.log" 2>&1 && bytes_of "$of.o"
}

report() {  # TABLE TITLE ARGUMENT...
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/numbers/sizes/$1.txt" \
    --page "$root/docs/sizes.md" --table "$1" --title "$2" "${@:3}"
}

arm="arm-none-eabi-g++ $(arm-none-eabi-g++ -dumpfullversion 2>/dev/null)"
riscv="riscv64-unknown-elf-g++ $(riscv64-unknown-elf-g++ -dumpfullversion 2>/dev/null)"

report_nodes() {
  report nodes "program" --percent 1 --slack 16 --limits "at most" --stacks "$root/tests/numbers/sizes/stacks.txt" \
    --column "Cortex-M0+" "$arm" "$of-m0plus" --column "Cortex-M0+ with LTO" "$arm" "$of-m0plus-lto" \
    --column "Cortex-M4" "$arm" "$of-m4" --column "Cortex-M4 with LTO" "$arm" "$of-m4-lto" \
    --column "rv32imac" "$riscv" "$of-rv32" --column "rv32imac with LTO" "$riscv" "$of-rv32-lto"
}

report_modules() {
  local preset columns=()
  for preset in "${presets[@]}"; do
    [ "$preset" = fair ] || columns+=(--column "Cortex-M0+, $preset" "$arm" "$of-m0plus-$preset-modules"
      --column "Cortex-M4, $preset" "$arm" "$of-m4-$preset-modules"
      --column "rv32imac, $preset" "$riscv" "$of-rv32-$preset-modules")
  done
  report modules "module" --percent 1 --slack 16 "${columns[@]}"
}

report_memory() {
  report memory "module" --column minimal "$arm" "$of-memory-minimal" --column "$(title_of fair)" "$arm" "$of-memory-fair" \
    --column slave "$arm" "$of-memory-slave" \
    --column full "$arm" "$of-memory-full"
}

report_things() {
  report things "one more" --column "flash" "$arm" "$of-things-flash" --column "RAM" "$arm" "$of-things-ram"
}

report_drivers() {
  report drivers "driver" --percent 1 --slack 16 --column "flash" "$arm" "$of-drivers" --column "RAM" "$arm" "$of-drivers-ram"
}

# Evaluates the functions of the C run time, too, which a program with the whole library contains.
stack_depths() {
  local of=$results/stack objects targets=(lexican lexican_full)
  build_m0plus -DLEXICAN_SIZES=ON || return
  rm -f "$of-depths" "$of-slave-depths"
  link_library slave && run_tap depths_of "$of-slave" "$root/tests/numbers/depth/calls.txt" \
    --only ", preset slave" CONodeProcess COTmrProcess
  link_library full && run_tap depths_of "$of" "$root/tests/numbers/depth/calls.txt"
  [ -f "$of-depths" ] && [ -f "$of-slave-depths" ] || return
  cat "$of-slave-depths" >>"$of-depths"
  planted_calls "a call without a line" '^base/timer.cpp' "no line lists what timer.Func() may call"
  planted_calls "a function that calls itself" '^limit' "leads to a function that calls itself"
  run_tap python3 "$root/tests/lanes/numbers.py" ${update_numbers:+--update} --committed "$root/tests/numbers/depth/depths.txt" \
    --page "$root/docs/sizes.md" --table stack --title function --remark "by way of" --column bytes "$arm" "$of-depths"
}

# Links all objects of a library and sets $objects to them.
link_library() {  # PRESET
  mapfile -t objects < <(objects_of "m0plus/lexican_$1")
  "${compile[@]}" "${objects[@]}" -nostartfiles "${specs[@]}" -Wl,-e,CONodeProcess -o "$of.elf" >"$of.log" 2>&1 ||
    { fail "link of the library, $1" "$of.log"; return 1; }
}

depths_of() {  # RESULT CALLS [OPTION...]
  python3 -B "$root/tests/numbers/depth/depth.py" --objects "${objects[@]}" --sources "$root/src" --calls "$2" \
    --program "$results/stack.elf" --tools arm-none-eabi- --depths "$1-depths" --ways "$1-ways" "${@:3}"
}

# Checks that depth.py detects what calls.txt does not list.
planted_calls() {  # WHAT LINES-LEFT-OUT WHY
  grep -v "$2" "$root/tests/numbers/depth/calls.txt" >"$of-planted"
  check "found: $1" calls_are_refused "$3"
}

calls_are_refused() {  # WHY
  ! depths_of "$of-of-planted" "$of-planted" >"$of-refused" && grep "^not ok .*$1" "$of-refused"
}

# Checks that numbers.py detects deviations.
self_test() {
  planted "a number that has grown" '{ $2 += NR == 1; print }'
  planted "a number that was not measured" 'NR > 1'
  planted "a number that is not committed" '{ print } NR == 1 { print "another", 1 }'
  check "found: a number above its limit" exceeds_limit
  sed 's/^| dictionary entry | 12/| dictionary entry | 13/' "$root/docs/sizes.md" >"$of-planted.md"
  check "found: a page with other numbers" is_refused "$of-planted.md" "$of-things-flash"
}

planted() {  # WHAT AWK-PROGRAM: changes what was measured
  awk -F '\t' -v OFS='\t' "$2" "$of-things-flash" >"$of-planted"
  check "found: $1" is_refused "$root/docs/sizes.md" "$of-planted"
}

exceeds_limit() {
  sed '/^dictionary entry |/s/.*/dictionary entry | 12 | 0 | 11/' "$root/tests/numbers/sizes/things.txt" >"$of-planted"
  ! python3 "$root/tests/lanes/numbers.py" --committed "$of-planted" --page "$root/docs/sizes.md" --table things \
    --title "one more" --limits "at most" --column flash "$arm" "$of-things-flash" --column RAM "$arm" "$of-things-ram" \
    >"$of-refused" && grep '^not ok dictionary entry, flash: 12, at most 11' "$of-refused"
}

is_refused() {  # PAGE FLASH
  ! python3 "$root/tests/lanes/numbers.py" --committed "$root/tests/numbers/sizes/things.txt" --page "$1" --table things \
    --title "one more" --column flash "$arm" "$2" --column RAM "$arm" "$of-things-ram"
}
