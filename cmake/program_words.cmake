# SPDX-License-Identifier: Apache-2.0

# lexican_program_words(TARGET NAME): installs a host program with its manual page and the completion scripts of the
# shells, which it prints itself ("NAME man", "NAME completion SHELL"), as the component NAME.
function(lexican_program_words target name)
  if(NOT CMAKE_CROSSCOMPILING)
    add_custom_command(OUTPUT ${name}.man COMMAND ${target} man > ${name}.man VERBATIM)
    foreach(shell IN ITEMS bash zsh fish)
      add_custom_command(OUTPUT ${name}.${shell} COMMAND ${target} completion ${shell} > ${name}.${shell} VERBATIM)
    endforeach()
    add_custom_target(${name}_words ALL DEPENDS ${name}.man ${name}.bash ${name}.zsh ${name}.fish)
  endif()
  if(NOT LEXICAN_INSTALL)
    return()
  endif()
  include(GNUInstallDirs)
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${name})
  if(TARGET ${name}_words)
    set(words ${CMAKE_CURRENT_BINARY_DIR}/${name})
    install(FILES ${words}.man DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME ${name}.1 COMPONENT ${name})
    install(FILES ${words}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${name}
      COMPONENT ${name})
    install(FILES ${words}.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _${name} COMPONENT ${name})
    install(FILES ${words}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT ${name})
  endif()
endfunction()
