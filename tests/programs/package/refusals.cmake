# SPDX-License-Identifier: Apache-2.0
# What lexican_generate() does not take, and where it finds no codict: one CASE; GENERATE is the file that has it. A
# script has no targets.
include(${GENERATE})
if(CASE STREQUAL "arguments")
  lexican_generate(TARGET pump DESCRIPTION pump.xdd LANGAUGE C)
elseif(CASE STREQUAL "target")
  lexican_generate(TARGET pump DESCRIPTION pump.xdd)
elseif(CASE STREQUAL "language")
  lexican_generate(TARGET pump DESCRIPTION pump.xdd LANGUAGE c++)
elseif(CASE STREQUAL "codict")
  set(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH OFF)
  set(CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH OFF)
  lexican_find_codict(codict)
endif()
