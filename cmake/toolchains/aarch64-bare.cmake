# SPDX-License-Identifier: Apache-2.0
# Bare-metal Cortex-A in 64 bits. Debian has no C library for it: the compiler is that for Linux, of which only libgcc
# is linked; the program supplies memcpy() and similar functions.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_ASM_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Vector registers must not be used, as interrupts do not save them; without caches and MMU accesses must be aligned.
set(LEXICAN_BARE "-ffreestanding -fno-pic -fno-stack-protector -mgeneral-regs-only -mstrict-align -mno-outline-atomics")
set(CMAKE_C_FLAGS_INIT "${LEXICAN_BARE}")
set(CMAKE_CXX_FLAGS_INIT "${LEXICAN_BARE}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -static -no-pie")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
