# SPDX-License-Identifier: Apache-2.0
# lexican_bare_metal_program(<target> <board> [LARGE]): builds an executable for a board, which is a machine of QEMU:
#
#   microbit      Cortex-M0       -D CMAKE_TOOLCHAIN_FILE=cmake/toolchains/arm-none-eabi.cmake -D LEXICAN_CPU=cortex-m0
#   mps2-an385    Cortex-M3       as above with LEXICAN_CPU=cortex-m3, or the code of a smaller core
#   mps2-an386    Cortex-M4F      as above with LEXICAN_CPU=cortex-m4 and LEXICAN_FLOAT_ABI=hard
#   virt          RISC-V rv32     -D CMAKE_TOOLCHAIN_FILE=cmake/toolchains/riscv32-none-elf.cmake
#
# LARGE gives a program on mps2-… 7 MiB of code and 9 MiB of RAM. main() takes no arguments; its result is QEMU's exit
# status. board.hpp declares the functions of the board.
# lexican_board_command(<variable> <board>) returns the command that runs a program, to which its path is to be
# appended.
set(LEXICAN_BOARDS_DIR ${CMAKE_CURRENT_LIST_DIR})

function(lexican_board_command variable board)
  set(semihosting -display none -monitor none -chardev stdio,id=host
    -semihosting-config enable=on,target=native,chardev=host)
  if(board STREQUAL "virt")
    set(command qemu-system-riscv32 -M virt -bios none ${semihosting} -serial none -kernel)
  else()
    set(command qemu-system-arm -M ${board} ${semihosting} -serial none -kernel)
  endif()
  set(${variable} ${command} PARENT_SCOPE)
endfunction()

# Library with the functions of the board, compiled with the options of the program, which may be for another core.
function(lexican_board board)
  set(library lexican_board_${board})
  if(TARGET ${library})
    return()
  endif()
  if(board STREQUAL "virt")
    set(cpu riscv)
    set(machine virt)
  elseif(board STREQUAL "microbit")
    set(cpu cortex_m)
    set(machine microbit)
  elseif(board MATCHES "^mps2-an38[56]$")
    set(cpu cortex_m)
    set(machine mps2)
  else()
    message(FATAL_ERROR "No board '${board}': microbit, mps2-an385, mps2-an386, virt")
  endif()
  set(here ${LEXICAN_BOARDS_DIR})
  add_library(${library} INTERFACE)
  target_sources(${library} INTERFACE ${here}/program.cpp ${here}/${cpu}/start.cpp)
  if(cpu STREQUAL "cortex_m")
    target_sources(${library} INTERFACE ${here}/system_calls.cpp)
  endif()
  target_include_directories(${library} INTERFACE ${here} ${here}/${cpu} ${here}/${machine})
  set_target_properties(${library} PROPERTIES LEXICAN_MEMORY ${here}/${machine}/memory)
endfunction()

function(lexican_bare_metal_program target board)
  lexican_board(${board})
  target_link_libraries(${target} PRIVATE lexican_board_${board})
  target_compile_options(${target} PRIVATE -ffunction-sections -fdata-sections
    $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit>)
  get_target_property(memory lexican_board_${board} LEXICAN_MEMORY)
  if("${ARGV2}" STREQUAL "LARGE" AND EXISTS ${memory}_large.ld)
    string(APPEND memory _large)
  endif()
  target_link_options(${target} PRIVATE -nostartfiles -Wl,--gc-sections)
  foreach(script IN ITEMS ${memory}.ld ${LEXICAN_BOARDS_DIR}/sections.ld)
    target_link_options(${target} PRIVATE "SHELL:-T ${script}")
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
  endforeach()
endfunction()
