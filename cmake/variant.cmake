# SPDX-License-Identifier: Apache-2.0

# lexican_variant(NAME DEFINITION...): builds the library with another configuration, for tests that compare several.
function(lexican_variant name)
  get_target_property(sources lexican SOURCES)
  list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/src/)
  get_target_property(options lexican COMPILE_OPTIONS)
  add_library(${name} STATIC ${sources})
  target_compile_options(${name} PRIVATE ${options})
  target_include_directories(${name}
    PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/config PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PUBLIC ${ARGN})
endfunction()
