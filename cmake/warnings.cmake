# SPDX-License-Identifier: Apache-2.0

# Gives a target of this project the project's warnings. Users of the library never see them.
function(lexican_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wcast-align -Wundef -Wdouble-promotion
    $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual>
    $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes>
    $<$<BOOL:${LEXICAN_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()
