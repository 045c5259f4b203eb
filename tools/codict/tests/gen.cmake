# SPDX-License-Identifier: Apache-2.0
# Tests over the bus of nodes whose dictionaries codict generates during the build, in both languages. They are omitted
# with the preset minimal, which is too small, and if codict is built without the stack and its demo.
if(TARGET lexican_demo_dictionary AND NOT LEXICAN_PRESET STREQUAL "minimal")
  add_executable(lexican_codict_node_tests ${lexican_root}/tests/stack/support/main.cpp gen_node.cpp gen_node_case.cpp gen_safety_case.cpp od_conformance.cpp
    od_conformance_case.cpp)
  foreach(language IN ITEMS C CXX)
    string(REPLACE CXX cpp name ${language})
    string(TOLOWER ${name} name)
    lexican_generate(TARGET lexican_codict_node_tests DESCRIPTION fixtures/gen/every_kind.eds NAME every_${name}
      LANGUAGE ${language})
    lexican_generate(TARGET lexican_codict_node_tests DESCRIPTION fixtures/gen/unmappable.eds NAME unmappable_${name}
      LANGUAGE ${language})
    set(form plain)
    if(language STREQUAL C)
      set(form zlib)
    endif()
    lexican_generate(TARGET lexican_codict_node_tests DESCRIPTION fixtures/gen/safety.eds NAME safety_${name}
      LANGUAGE ${language} EDS safety_${name}.eds OPTIONS --embed-eds ${form} --error-bits 2100)
  endforeach()
  target_include_directories(lexican_codict_node_tests PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(lexican_codict_node_tests PRIVATE
    LEXICAN_CODICT_FIXTURES="${CMAKE_CURRENT_SOURCE_DIR}/fixtures" LEXICAN_SOURCE_DIR="${lexican_root}"
    LEXICAN_CODICT_GENERATED="${CMAKE_CURRENT_BINARY_DIR}")
  target_link_libraries(lexican_codict_node_tests PRIVATE
    lexican_demo_dictionary lexican_codict fmt::fmt lexican::lexican lexican_doctest
    lexican::lexican_can_virtual lexican::lexican_timer_software lexican::lexican_nvm_ram ZLIB::ZLIB)
  lexican_warnings(lexican_codict_node_tests)
  target_compile_options(lexican_codict_node_tests PRIVATE ${LEXICAN_TEST_OPTIONS})
  add_test(NAME lexican_codict_node_tests COMMAND lexican_codict_node_tests)
  if(NOT LEXICAN_SANITIZE)
    add_test(NAME codict_verify COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/verify_test.sh $<TARGET_FILE:codict> ${lexican_root}
      ${CMAKE_CURRENT_SOURCE_DIR}/fixtures ${CMAKE_CURRENT_BINARY_DIR}/verify)
  endif()
endif()

# Compilers for the dictionaries of the corpus.
find_package(Threads REQUIRED)
target_link_libraries(lexican_codict_core_tests PRIVATE Threads::Threads ZLIB::ZLIB)
target_compile_definitions(lexican_codict_core_tests PRIVATE LEXICAN_CC="${CMAKE_C_COMPILER}"
  LEXICAN_CXX="${CMAKE_CXX_COMPILER}")
