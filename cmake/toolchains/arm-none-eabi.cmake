# SPDX-License-Identifier: Apache-2.0
# Bare-metal Arm: -D LEXICAN_CPU=cortex-m0, cortex-m4, cortex-a9, …; -D LEXICAN_FLOAT_ABI=hard for a core with
# floating point.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(LEXICAN_CPU cortex-m0 CACHE STRING "Value of -mcpu")
set(LEXICAN_FLOAT_ABI "" CACHE STRING "Value of -mfloat-abi, or the compiler's own")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LEXICAN_CPU LEXICAN_FLOAT_ABI)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# If the option were given twice, the compiler would link the libraries of another core.
if(LEXICAN_CPU MATCHES "cortex-a")
  set(lexican_flags "-mcpu=${LEXICAN_CPU} -marm")
else()
  set(lexican_flags "-mcpu=${LEXICAN_CPU} -mthumb")
endif()
if(LEXICAN_FLOAT_ABI)
  string(APPEND lexican_flags " -mfloat-abi=${LEXICAN_FLOAT_ABI}")
endif()
set(CMAKE_C_FLAGS_INIT "${lexican_flags}")
set(CMAKE_CXX_FLAGS_INIT "${lexican_flags}")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
