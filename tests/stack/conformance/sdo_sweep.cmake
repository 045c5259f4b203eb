# SPDX-License-Identifier: Apache-2.0
# lexican_sdo_sweep(<target>): the table of the SDO server's reactions as part of a test program, which may run where
# there is no file.
set(LEXICAN_SDO_SWEEP_GOLDEN ${CMAKE_CURRENT_LIST_DIR}/sdo_sweep_golden.txt)

function(lexican_sdo_sweep target)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${LEXICAN_SDO_SWEEP_GOLDEN})
  file(READ ${LEXICAN_SDO_SWEEP_GOLDEN} LEXICAN_SDO_SWEEP)
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/sdo_sweep)
  file(CONFIGURE OUTPUT ${directory}/sdo_sweep_golden.inc @ONLY
    CONTENT "R\"golden(@LEXICAN_SDO_SWEEP@)golden\"\n")
  target_include_directories(${target} PRIVATE ${directory})
endfunction()
