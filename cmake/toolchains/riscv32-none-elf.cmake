# SPDX-License-Identifier: Apache-2.0
# Bare-metal RISC-V, 32 bits: -D LEXICAN_CPU=rv32imac (the value of -march).
#
# The compiler is gcc-riscv64-unknown-elf, the C library is picolibc. Debian has no C++ library for this CPU. The
# headers of libstdc++ work with any 32-bit CPU whose C library is derived from newlib, like picolibc: those of
# libstdc++-arm-none-eabi-newlib are used, with the configuration of its smallest Arm core. The content of libstdc++.a
# is missing (streams, std::map, exceptions …): programs must not use it, and are linked with the C compiler.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR riscv32)
set(LEXICAN_CPU rv32imac CACHE STRING "Value of -march")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LEXICAN_CPU)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_C_COMPILER riscv64-unknown-elf-gcc)
set(CMAKE_CXX_COMPILER riscv64-unknown-elf-g++)

file(GLOB cxx_headers LIST_DIRECTORIES true /usr/include/newlib/c??/*)  # c++/VERSION
list(GET cxx_headers -1 cxx_headers)
set(cpu "-march=${LEXICAN_CPU}_zicsr -mabi=ilp32 --specs=picolibc.specs")
set(CMAKE_C_FLAGS_INIT "${cpu}")
set(CMAKE_CXX_FLAGS_INIT
  "${cpu} -isystem ${cxx_headers} -isystem ${cxx_headers}/arm-none-eabi/thumb/v6-m/nofp -isystem ${cxx_headers}/backward")
set(CMAKE_CXX_LINK_EXECUTABLE
  "<CMAKE_C_COMPILER> <FLAGS> -march=${LEXICAN_CPU} <CMAKE_CXX_LINK_FLAGS> <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
