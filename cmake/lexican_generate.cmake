# SPDX-License-Identifier: Apache-2.0
# lexican_generate(): generates the object dictionary of a target from a device description during the build.

# lexican_generate(TARGET app DESCRIPTION device.eds [NAME name] [LANGUAGE C|CXX] [OUTPUT_DIRECTORY dir]
#                  [EDS file] [XDD file] [VERIFY ON|OFF] [OPTIONS …])
#
# Adds NAME_od.h and NAME_od.c or NAME_od.cpp to a target of this directory, and the header's directory to its include
# directories. NAME: name of the files; LANGUAGE: by default CXX if the project enables it, as more is checked at
# compile time; EDS, XDD: descriptions of the generated dictionary, in the build directory; OPTIONS: more options of
# codict gen. The target must link lexican::lexican.
#
# VERIFY: starts a node with the dictionary and lexican::lexican when the target is built; the build fails if the stack
# reports an error. ON by default, except in a cross build or without a target lexican::lexican.
function(lexican_generate)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "TARGET;DESCRIPTION;NAME;LANGUAGE;OUTPUT_DIRECTORY;EDS;XDD;VERIFY"
    "OPTIONS")
  if(NOT arg_TARGET OR NOT arg_DESCRIPTION OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "lexican_generate(TARGET target DESCRIPTION file …) is its form, given is: ${ARGV}")
  elseif(arg_LANGUAGE AND NOT arg_LANGUAGE MATCHES "^(C|CXX)$")
    message(FATAL_ERROR "lexican_generate: LANGUAGE is C or CXX, not ${arg_LANGUAGE}.")
  elseif(NOT TARGET ${arg_TARGET})
    message(FATAL_ERROR "lexican_generate: there is no target ${arg_TARGET}: add_executable() or add_library() goes before.")
  endif()
  get_filename_component(description ${arg_DESCRIPTION} ABSOLUTE)
  if(NOT arg_NAME)
    lexican_generated_name(${description} arg_NAME)
  endif()
  if(NOT arg_OUTPUT_DIRECTORY)
    set(arg_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${arg_TARGET}_od)
  endif()
  if(NOT arg_LANGUAGE)
    get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
    set(arg_LANGUAGE C)
    if(CXX IN_LIST languages)
      set(arg_LANGUAGE CXX)
    endif()
  endif()
  set(language c)
  set(source ${arg_OUTPUT_DIRECTORY}/${arg_NAME}_od.c)
  if(arg_LANGUAGE STREQUAL "CXX")
    set(language c++)
    string(APPEND source pp)
  endif()
  set(files ${arg_OUTPUT_DIRECTORY}/${arg_NAME}_od.h ${source})
  foreach(format IN ITEMS EDS XDD)
    if(arg_${format})
      get_filename_component(path ${arg_${format}} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_BINARY_DIR})
      string(TOLOWER --${format} option)
      list(APPEND arg_OPTIONS ${option} ${path})
      list(APPEND files ${path})
    endif()
  endforeach()
  lexican_find_codict(codict)
  if(NOT DEFINED arg_VERIFY)
    set(arg_VERIFY ON)
  endif()
  if(CMAKE_CROSSCOMPILING OR NOT TARGET lexican::lexican)
    set(arg_VERIFY OFF)
  endif()
  set(dictionary ${files})
  if(arg_VERIFY)
    string(REGEX REPLACE "_od(\\.[a-z]+)$" "_verify\\1" verify "${source}")
    list(APPEND arg_OPTIONS --verify-source ${verify})
    list(APPEND files ${verify})
  endif()

  # codict does not write unchanged files. Ninja supports that; other generators would run the command in every build.
  set(touch)
  if(NOT CMAKE_GENERATOR MATCHES "Ninja")
    set(touch COMMAND ${CMAKE_COMMAND} -E touch_nocreate ${files})
  endif()
  add_custom_command(OUTPUT ${files}
    COMMAND ${codict} gen ${description} --output ${arg_OUTPUT_DIRECTORY} --name ${arg_NAME} --language ${language}
      ${arg_OPTIONS}
    ${touch}
    DEPENDS ${description} ${codict}
    COMMENT "" VERBATIM)
  target_sources(${arg_TARGET} PRIVATE ${dictionary})
  target_include_directories(${arg_TARGET} PUBLIC $<BUILD_INTERFACE:${arg_OUTPUT_DIRECTORY}>)
  if(arg_VERIFY)
    lexican_verify_dictionary(${arg_TARGET} ${arg_NAME} "${arg_OUTPUT_DIRECTORY}" "${source}" "${verify}")
  endif()
endfunction()

# Builds and runs the program that starts a node with the dictionary, before its target is built.
function(lexican_verify_dictionary target name directory source verify)
  set(program ${target}_verify_${name})
  add_executable(${program} EXCLUDE_FROM_ALL "${source}" "${verify}")
  target_include_directories(${program} PRIVATE "${directory}")
  target_link_libraries(${program} PRIVATE lexican::lexican)
  set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/lexican_verify")
  add_custom_command(TARGET ${program} POST_BUILD COMMAND ${program} VERBATIM)
  add_dependencies(${target} ${program})
endfunction()

# Returns the name that codict gives to a dictionary by default.
function(lexican_generated_name path result)
  get_filename_component(name ${path} NAME_WLE)
  string(TOLOWER "${name}" name)
  string(REGEX REPLACE "[^a-z0-9]+" "_" name "${name}")
  string(REGEX REPLACE "^_|_$" "" name "${name}")
  string(REGEX REPLACE "^([0-9])" "n\\1" name "${name}")
  set(${result} ${name} PARENT_SCOPE)
endfunction()

# Returns a codict that runs on this machine: LEXICAN_CODICT, that of this build, an installed one, or one that is built
# for this machine from the sources of this project.
function(lexican_find_codict result)
  if(NOT LEXICAN_CODICT AND TARGET codict AND NOT CMAKE_CROSSCOMPILING)
    set(${result} codict PARENT_SCOPE)
    return()
  endif()
  find_program(LEXICAN_CODICT codict HINTS ${LEXICAN_CODICT_HINT} NO_CMAKE_FIND_ROOT_PATH
    DOC "The program codict, for the machine that builds")
  if(LEXICAN_CODICT)
    set(${result} ${LEXICAN_CODICT} PARENT_SCOPE)
    return()
  endif()
  get_filename_component(root ${CMAKE_CURRENT_FUNCTION_LIST_DIR} DIRECTORY)
  if(NOT EXISTS ${root}/tools/codict)
    message(FATAL_ERROR "lexican_generate: this installation of Lexican has no codict. Install Lexican with -DLEXICAN_TOOLS=ON, "
      "or give the path of a codict: -DLEXICAN_CODICT=….")
  endif()
  set(directory ${CMAKE_BINARY_DIR}/lexican_host_codict)
  set(program ${directory}/codict${CMAKE_HOST_EXECUTABLE_SUFFIX})
  if(NOT TARGET lexican_host_codict)
    include(ExternalProject)
    # Built without the target's toolchain and flags, by the compiler that CMake finds on this machine. Not optimised:
    # optimisation takes minutes, and saves milliseconds per run.
    ExternalProject_Add(lexican_host_codict
      SOURCE_DIR ${root}/tools/codict
      BINARY_DIR ${directory}
      PREFIX ${directory}/step
      CONFIGURE_COMMAND ${CMAKE_COMMAND} -E env --unset=CC --unset=CXX --unset=CFLAGS --unset=CXXFLAGS --unset=LDFLAGS
        --unset=CMAKE_TOOLCHAIN_FILE
        ${CMAKE_COMMAND} -G ${CMAKE_GENERATOR} -S ${root}/tools/codict -B ${directory} -DCMAKE_BUILD_TYPE=Release
        -DCMAKE_CXX_FLAGS_RELEASE=-O0
      BUILD_COMMAND ${CMAKE_COMMAND} --build ${directory} --target codict
      BUILD_ALWAYS ON
      BUILD_BYPRODUCTS ${program}
      INSTALL_COMMAND ""
      EXCLUDE_FROM_ALL ON
      LOG_CONFIGURE ON LOG_BUILD ON LOG_OUTPUT_ON_FAILURE ON)
  endif()
  set(${result} ${program} PARENT_SCOPE)
endfunction()
