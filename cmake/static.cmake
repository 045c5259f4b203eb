# SPDX-License-Identifier: Apache-2.0
# Programs without other files: LEXICAN_STATIC, and the libraries that they are linked to then.
option(LEXICAN_STATIC "Link codict and lexican statically: they run on any Linux of this architecture" OFF)
set(lexican_fmt fmt::fmt)
set(lexican_pugixml pugixml::pugixml)
if(LEXICAN_STATIC)
  set(CMAKE_FIND_LIBRARY_SUFFIXES .a)  # find_library() and the modules that call it
  set(lexican_fmt fmt::fmt-header-only)  # Debian has no static library of fmt
  set(lexican_pugixml pugixml::static)
endif()

# Links a program statically with LEXICAN_STATIC, in a release build without symbols. Call it after
# target_link_libraries().
function(lexican_static target)
  if(LEXICAN_STATIC)
    target_link_options(${target} PRIVATE -static $<$<CONFIG:Release>:-s>)
    if(CURSES_FOUND)  # FindCurses does not return the part of a static ncurses that is in a library of its own
      find_library(LEXICAN_TINFO tinfo REQUIRED)
      target_link_libraries(${target} PRIVATE ${LEXICAN_TINFO})
    endif()
  endif()
endfunction()
