# SPDX-License-Identifier: Apache-2.0

# lexican_variant(NAME DEFINITION...): builds the library with another configuration, for tests that compare several.
# Only sources whose preprocessed text differs from that of lexican are compiled; the other objects are lexican's.
# NAME.objects in the build directory lists all objects. Requires python3.
function(lexican_variant name)
  get_target_property(sources lexican SOURCES)
  get_target_property(options lexican COMPILE_OPTIONS)
  get_target_property(definitions lexican COMPILE_DEFINITIONS)
  get_target_property(headers lexican PRECOMPILE_HEADERS)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} -std=c++17")
  execute_process(COMMAND python3 ${PROJECT_SOURCE_DIR}/cmake/changed_sources.py ${PROJECT_SOURCE_DIR} ${sources}
    -- ${CMAKE_CXX_COMPILER} ${flags} -- ${definitions} -- ${ARGN}
    OUTPUT_VARIABLE changed COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" changed "${changed}")
  list(JOIN changed "|" any)
  set(unchanged "$<FILTER:$<TARGET_OBJECTS:lexican>,EXCLUDE,/(${any}|cmake_pch[.]hxx)[.](o|gch)>")
  list(TRANSFORM changed PREPEND ${PROJECT_SOURCE_DIR}/src/)
  add_library(${name} STATIC ${changed} ${unchanged})
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${name}.objects
    CONTENT "$<JOIN:$<FILTER:$<TARGET_OBJECTS:${name}>,EXCLUDE,[.]gch$>;${unchanged},\n>\n")
  target_compile_options(${name} PRIVATE ${options})
  target_include_directories(${name}
    PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/config PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PUBLIC ${ARGN})
  if(headers)
    target_precompile_headers(${name} PRIVATE ${headers})
  endif()
endfunction()
